//! A long computation ends when it is asked to, and not before.
//!
//! One test in a program of its own: an interruption ends all computations that run.

mod support;

use std::thread;
use std::time::Duration;

use support::tetrahedra::kuhn_grid;
use vtu2contour::field::{RecoveryDegree, recover_gradients};
use vtu2contour::interruption::{Interrupted, interruptible, request};

#[test]
fn computations_end_when_asked_and_not_before() {
    let mesh = kuhn_grid(4);
    let values: Vec<f64> = mesh.points().iter().map(|p| (3.0 * p.x).sin() + p.y * p.z).collect();
    let recover = || recover_gradients(&mesh, &values, RecoveryDegree::default());
    let whole = interruptible(recover).unwrap();
    assert_eq!(whole.len(), values.len());
    thread::scope(|scope| {
        let endless = scope.spawn(|| interruptible(|| while recover().len() == values.len() {}));
        thread::sleep(Duration::from_millis(100));
        request();
        assert_eq!(endless.join().unwrap(), Err(Interrupted));
    });
    assert_eq!(interruptible(recover), Ok(whole));
    let panics = thread::spawn(|| interruptible(|| panic!("as it is")));
    assert_eq!(panics.join().unwrap_err().downcast_ref(), Some(&"as it is"));
}
