//! Tables 5.2 and 5.4: times, as ratios to the first interpolant of each.

use std::hint::black_box;
use std::time::Instant;

use vtu2contour::field::Field;
use vtu2contour::pde::Pde;

use crate::ratio;
use crate::support::meshes::Random;
use crate::support::table::Table;
use crate::support::tetrahedra::random_cube;
use crate::support::{problem4, table_5_1, table_5_3};

/// The least time of several runs on one thread, in seconds: what else the machine does
/// makes times longer, never shorter.
fn seconds<T>(run: impl Fn() -> T + Sync) -> f64 {
    let time = |_| {
        let start = Instant::now();
        black_box(run());
        start.elapsed().as_secs_f64()
    };
    let one = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a thread");
    one.install(|| (0..7).map(time).fold(f64::INFINITY, f64::min))
}

fn ratios<const N: usize>(times: [f64; N]) -> impl Iterator<Item = String> {
    times.into_iter().map(move |time| ratio(time / times[0]))
}

/// Times on triangles relative to the PCI's.
pub fn table_5_2() -> Vec<Table> {
    let mut columns = vec!["points", "who"];
    columns.extend(table_5_1::MEMBERS.map(table_5_1::Member::name));
    columns.push("PCI, seconds");
    let mut table = Table::new("Table 5.2: times relative to the PCI, problem 4", &columns);
    let pde = Pde::parse(problem4::PDE, &[], &[]).expect("the PDE is one");
    for ((size, _), thesis) in table_5_1::THESIS.into_iter().zip(table_5_1::THESIS_TIMES) {
        let mesh = table_5_1::Points::RandomWithSides.mesh(size, 1);
        let (values, gradients) = problem4::at_points(&mesh);
        let field = Field { values: &values, gradients: &gradients };
        for way in [table_5_1::Way::Thesis, table_5_1::Way::Ours] {
            let ours =
                table_5_1::MEMBERS.map(|member| seconds(|| member.build(&mesh, field, &pde, way)));
            if way == table_5_1::Way::Thesis {
                push(&mut table, size, "thesis", thesis);
            }
            push(&mut table, size, way.name(), ours);
        }
    }
    vec![table]
}

fn push<const N: usize>(table: &mut Table, points: usize, who: &str, times: [f64; N]) {
    let mut line = vec![points.to_string(), who.to_owned()];
    line.extend(ratios(times));
    line.push(format!("{:.2e}", times[0]));
    table.push(line);
}

/// Times on tetrahedra relative to p3's.
pub fn table_5_4() -> Vec<Table> {
    let mut columns = vec!["points", "who"];
    columns.extend(table_5_3::MEMBERS.map(table_5_3::Member::name));
    columns.push("p3, seconds");
    let tables = table_5_3::THESIS.iter().zip(table_5_3::THESIS_TIMES);
    tables
        .map(|((problem, sizes), thesis)| {
            let title = format!("Table 5.4: times relative to p3, problem {}", problem.number);
            let mut table = Table::new(title, &columns);
            let pde = Pde::parse(problem.pde, &[], &[]).expect("the PDE is one");
            for ((size, _), thesis) in sizes.iter().zip(thesis) {
                let mesh = random_cube(&mut Random(1), *size);
                let (values, gradients) = problem.at_points(&mesh);
                let field = Field { values: &values, gradients: &gradients };
                let way = table_5_1::Way::Ours;
                let ours = table_5_3::MEMBERS.map(|member| {
                    seconds(|| member.build(&mesh, field, &way.equation(&pde), &way.options()))
                });
                push(&mut table, *size, "thesis", thesis);
                push(&mut table, *size, way.name(), ours);
            }
            table
        })
        .collect()
}
