//! The thesis' tables, ours beside the thesis' own figures, as Markdown.
//!
//! `cargo run --release --example paper-tables -- 5.7`
//!
//! Without an argument all tables are printed. Times are not compared: the
//! thesis' are those of MATLAB on a machine of 2010.

#[path = "../tests/support/mod.rs"]
mod support;

use support::{table_5_3, table_5_7};

fn main() {
    let wanted: Vec<String> = std::env::args().skip(1).collect();
    let tables: [(&str, fn()); 2] = [("5.3", print_5_3), ("5.7", print_5_7)];
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
