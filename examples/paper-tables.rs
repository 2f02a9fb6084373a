//! The thesis' tables, ours beside the thesis' own figures, as Markdown.
//!
//! `cargo run --release --example paper-tables -- 5.7`
//!
//! Without an argument all tables are printed. Times are not compared: the
//! thesis' are those of MATLAB on a machine of 2010.

#[path = "../tests/support/mod.rs"]
mod support;

use support::tables_of_surfaces::TABLES;
use support::{table_5_3, table_5_7};

fn main() {
    let wanted: Vec<String> = std::env::args().skip(1).collect();
    let tables: [(&str, fn()); 4] =
        [("5.3", print_5_3), ("5.7", print_5_7), ("5.10", print_5_10), ("5.11", print_5_11)];
    for (number, print) in tables {
        if wanted.is_empty() || wanted.iter().any(|name| name == number) {
            print();
        }
    }
}

fn print_5_3() {
    println!("Table 5.3, column p3: average error of tri-cubics on random tetrahedra");
    println!();
    println!(
        "| problem | points | tetrahedra | thesis, discontinuous | the same on our mesh \
         | ours, continuous | ours without the PDE | linear |"
    );
    println!("|---|---|---|---|---|---|---|---|");
    for row in table_5_3::rows(usize::MAX, 1) {
        let table_5_3::Row { problem, points, tetrahedra, thesis, discontinuous, .. } = row;
        let table_5_3::Row { continuous, without_pde, linear, .. } = row;
        println!(
            "| {problem} | {points} | {tetrahedra} | {thesis:.2e} | {discontinuous:.2e} \
             | {continuous:.2e} | {without_pde:.2e} | {linear:.2e} |"
        );
    }
    println!();
}

fn print_5_7() {
    println!("Table 5.7: average error of the contours of problem 4, triangles of good quality");
    println!();
    println!(
        "| points | method | thesis | ours | with the linear predictor | points of the file |"
    );
    println!("|---|---|---|---|---|---|");
    for row in table_5_7::rows() {
        let table_5_7::Row { points, method, thesis, ours, linear_predictor, of_points } = row;
        println!(
            "| {points} | {method} | {thesis:.2e} | {ours:.2e} | {linear_predictor:.2e} \
             | {of_points:.2e} |"
        );
    }
}

fn print_5_10() {
    print_surfaces(0);
}

fn print_5_11() {
    print_surfaces(1);
}

fn print_surfaces(which: usize) {
    let table = TABLES[which];
    println!(
        "Table {}: average error at the middles of the triangles, problem {}, level {}",
        table.number, table.problem.number, table.level
    );
    println!();
    println!("| grid | nSide | thesis | triangles | ours | triangles | linear (VTK) | triangles |");
    println!("|---|---|---|---|---|---|---|---|");
    for row in table.compare(usize::MAX) {
        println!(
            "| {0}³ | {1} | {2:.2e} | {3} | {4:.2e} | {5} | {6:.2e} | {7} |",
            row.grid,
            row.points,
            row.thesis.0,
            row.thesis.1,
            row.ours.0,
            row.ours.1,
            row.linear.0,
            row.linear.1
        );
    }
    println!();
}
