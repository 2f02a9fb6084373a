//! The thesis' tables, ours beside the thesis' own figures.
//!
//! `cargo run --release --example paper-tables -- 5.7`
//!
//! Without an argument all tables are printed. Times are not compared: the
//! thesis' are those of MATLAB on a machine of 2010.

mod problem4;
mod table_5_7;

fn main() {
    let wanted: Vec<String> = std::env::args().skip(1).collect();
    let tables: [(&str, fn()); 1] = [("5.7", table_5_7::print)];
    for (number, print) in tables {
        if wanted.is_empty() || wanted.iter().any(|name| name == number) {
            print();
        }
    }
}
