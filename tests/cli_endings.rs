//! How the program ends when it cannot finish: a full disk, Ctrl-C, `kill`.
#![cfg(unix)]

#[path = "support/program.rs"]
mod program;

use std::os::unix::process::ExitStatusExt;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use program::{Bench, sample};
use vtu2contour::vtk::{PvdEntry, write_pvd};

const PROGRAM: &str = env!("CARGO_BIN_EXE_vtu2contour");

/// All names in the bench's folder and in those that it holds.
fn names(bench: &Bench) -> Vec<String> {
    let mut folders = vec![bench.folder.path().to_owned()];
    let mut names = Vec::new();
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            names.push(path.file_name().unwrap().to_str().unwrap().to_owned());
            if path.is_dir() {
                folders.push(path);
            }
        }
    }
    names.sort();
    names
}

/// Runs the program where no file may be larger than so many bytes.
fn run_with_little_space(bench: &Bench, blocks: u32, arguments: &[&str]) -> String {
    let script = format!("ulimit -f {blocks}; exec \"$0\" \"$@\"");
    let mut command = Command::new("sh");
    command.args(["-c", &script, PROGRAM]).args(arguments).current_dir(bench.folder.path());
    let output = command.output().unwrap();
    let said = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(1), "{arguments:?}: {said}");
    assert_eq!(said.lines().count(), 1, "{said}");
    said
}

#[test]
fn a_disk_that_fills_up_is_one_clear_line_and_leaves_nothing() {
    let bench = Bench::new();
    let steps: Vec<_> =
        (0..2).map(|n| PvdEntry::new(f64::from(n), sample("problem4.vtu"))).collect();
    write_pvd(bench.path("run.pvd"), &steps).unwrap();
    std::fs::write(bench.path("old.vtp"), "old").unwrap();
    let before = names(&bench);
    let input = sample("problem4.vtu");
    for (input, output) in [
        (&input[..], "old.vtp"),
        (&input, "out.vtu"),
        (&input, "out.svg"),
        (&input, "out.pvtp"),
        ("run.pvd", "out.pvd"),
    ] {
        let said = run_with_little_space(&bench, 8, &[input, "-o", output]);
        let file = output.replace("out.pvd", "out/out_0.vtp").replace("out.pvtp", "out/out_0.vtp");
        assert!(said.contains(&format!("cannot write '{file}': it would be larger")), "{said}");
        assert_eq!(names(&bench), before, "{output}");
    }
    assert_eq!(std::fs::read(bench.path("old.vtp")).unwrap(), b"old");
    let said = run_with_little_space(&bench, 0, &[&input, "-o", "out.vtp", "--stats", "s.json"]);
    assert!(said.contains("cannot write"), "{said}");
    assert_eq!(names(&bench), before);
}

#[test]
fn an_interrupted_run_leaves_nothing() {
    let bench = Bench::new();
    let steps = vec![PvdEntry::new(0.0, sample("problem4.vtu")); 10_000];
    write_pvd(bench.path("run.pvd"), &steps).unwrap();
    let before = names(&bench);
    for (name, number) in [("INT", 2), ("TERM", 15)] {
        let mut child = Command::new(PROGRAM)
            .args(["run.pvd", "-o", "out.pvd", "--stats", "s.json", "-v", "0.5"])
            .current_dir(bench.folder.path())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        let start = Instant::now();
        // the list, the counts, the folder, and some steps
        while names(&bench).len() < before.len() + 6 {
            assert!(start.elapsed() < Duration::from_secs(60), "{:?}", names(&bench));
            assert_eq!(child.try_wait().unwrap(), None, "it ended too soon");
            std::thread::sleep(Duration::from_millis(1));
        }
        let id = child.id().to_string();
        assert!(Command::new("kill").args(["-s", name, &id]).status().unwrap().success());
        assert_eq!(child.wait().unwrap().signal(), Some(number));
        assert_eq!(names(&bench), before, "{name}");
    }
}

#[test]
fn a_killed_run_leaves_no_half_file_under_the_outputs_name() {
    let bench = Bench::new();
    std::fs::write(bench.path("old.vtp"), "old").unwrap();
    let input = sample("problem4.vtu");
    let mut child = Command::new(PROGRAM)
        .args([&input, "-o", "old.vtp", "-n", "60000", "--tolerance", "1e-5"])
        .current_dir(bench.folder.path())
        .stderr(Stdio::null())
        .spawn()
        .unwrap();
    while names(&bench).len() < 2 {
        assert_eq!(child.try_wait().unwrap(), None, "it ended too soon");
        std::thread::sleep(Duration::from_millis(1));
    }
    child.kill().unwrap();
    assert_eq!(child.wait().unwrap().signal(), Some(9));
    assert_eq!(std::fs::read(bench.path("old.vtp")).unwrap(), b"old");
}
