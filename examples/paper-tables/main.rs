//! The thesis' tables and figures, ours beside the thesis' own.
//!
//! `cargo run --release --example paper-tables` prints all tables as text;
//! `-- 5.1 5.7 --markdown` those two as Markdown; `-- --figures FOLDER` draws figures 5.8
//! to 5.10, a picture for each interpolant. Times are ratios within one run: the thesis'
//! are those of MATLAB on a machine of 2010.

#[path = "../../tests/support/mod.rs"]
mod support;

mod figures;
mod times;

use std::error::Error;
use std::path::Path;

use support::table::{Style, Table, ratio, short};
use support::tables_of_refinement;
use support::tables_of_surfaces::TABLES;
use support::{order::order, table_5_1, table_5_3, table_5_7};
use table_5_1::Points;

/// Makes what is called a table in the thesis.
type Make = fn() -> Vec<Table>;

fn main() -> Result<(), Box<dyn Error>> {
    let mut wanted: Vec<String> = std::env::args().skip(1).collect();
    if let Some(place) = wanted.iter().position(|word| word == "--figures") {
        let folder = wanted.get(place + 1).ok_or("--figures needs a folder")?;
        return figures::draw(Path::new(folder));
    }
    let markdown = wanted.iter().any(|word| word == "--markdown");
    let style = if markdown { Style::Markdown } else { Style::Text };
    wanted.retain(|word| word != "--markdown");
    let tables: [(&str, Make); 12] = [
        ("5.1", tables_5_1),
        ("5.2", times::table_5_2),
        ("5.3", tables_5_3),
        ("5.4", times::table_5_4),
        ("5.7", || vec![table_5_7()]),
        ("5.10", || vec![surfaces(0)]),
        ("5.11", || vec![surfaces(1)]),
        ("5.12", || vec![refinement(0)]),
        ("5.13", || vec![refinement(1)]),
        ("5.14", || vec![refinement(2)]),
        ("5.15", || vec![refinement(3)]),
        ("5.16", || vec![refinement(4)]),
    ];
    if let Some(unknown) = wanted.iter().find(|name| !tables.iter().any(|(n, _)| n == name)) {
        let known: Vec<&str> = tables.iter().map(|(number, _)| *number).collect();
        return Err(format!("no table {unknown}; there are {}", known.join(", ")).into());
    }
    for (number, make) in tables {
        if wanted.is_empty() || wanted.iter().any(|name| name == number) {
            make().iter().for_each(|table| print!("{}", table.render(style)));
        }
    }
    Ok(())
}

fn tables_5_1() -> Vec<Table> {
    [Points::RandomWithSides, Points::Random, Points::Quality].map(table_5_1).to_vec()
}

fn table_5_1(points: Points) -> Table {
    let mut columns = vec!["points", "who"];
    columns.extend(table_5_1::MEMBERS.map(table_5_1::Member::name));
    let mut table = Table::new(
        format!(
            "Table 5.1: average error on problem 4, points {}, median of 9 meshes\n\
             (in brackets: per cent of the triangles without a piece of their own)",
            points.name()
        ),
        &columns,
    );
    let rows = table_5_1::rows(points, usize::MAX, 1..=9);
    for (size, thesis) in table_5_1::THESIS {
        let mut line = vec![size.to_string(), "thesis".to_owned()];
        line.extend(thesis.map(short));
        table.push(line);
        for row in rows.iter().filter(|row| row.points == size) {
            let mut line = vec![size.to_string(), row.way.name().to_owned()];
            line.extend(row.errors.iter().zip(row.left_out).map(|(&error, part)| {
                let part =
                    if part > 0.0 { format!(" ({:.0})", 100.0 * part) } else { String::new() };
                short(error) + &part
            }));
            table.push(line);
        }
    }
    table
}

fn tables_5_3() -> Vec<Table> {
    let rows = table_5_3::rows(usize::MAX, 1);
    [5, 6].map(|problem| table_of_problem(problem, &rows)).to_vec()
}

fn table_of_problem(problem: usize, rows: &[table_5_3::Row]) -> Table {
    let columns = [
        "points",
        "tetrahedra",
        "who",
        "p3",
        "p2",
        "p̂2",
        "continuous",
        "no PDE",
        "quadratic",
        "linear",
    ];
    let title = format!("Table 5.3: average error on random tetrahedra, problem {problem}");
    let mut table = Table::new(title, &columns);
    let rows: Vec<&table_5_3::Row> = rows.iter().filter(|row| row.problem == problem).collect();
    type Errors = fn(&table_5_3::Row) -> Vec<f64>;
    let ways: [(&str, Errors); 3] = [
        ("thesis", |row| row.thesis.to_vec()),
        ("its way, our mesh", |row| row.as_thesis.to_vec()),
        ("ours", |row| {
            let others = [row.continuous, row.without_pde, row.quadratic_precision, row.linear];
            row.family.into_iter().chain(others).collect()
        }),
    ];
    for row in &rows {
        for (who, errors) in ways {
            let mut line = vec![row.points.to_string(), row.tetrahedra.to_string(), who.to_owned()];
            line.extend(errors(row).into_iter().map(short));
            table.push(line);
        }
    }
    for (who, errors) in ways {
        let mut line = vec!["order".to_owned(), String::new(), who.to_owned()];
        let column = |n: usize| {
            let points = rows.iter().map(|row| (width(row.points), errors(row)[n]));
            order(&points.collect::<Vec<_>>())
        };
        line.extend((0..errors(rows[0]).len()).map(|n| format!("{:.2}", column(n))));
        table.push(line);
    }
    table
}

/// The mean distance of points in the unit cube, but for a factor.
fn width(points: usize) -> f64 {
    (points as f64).powf(-1.0 / 3.0)
}

fn table_5_7() -> Table {
    let mut table = Table::new(
        "Table 5.7: average error of the contours of problem 4, triangles of good quality",
        &["points", "method", "thesis", "ours", "with the linear predictor", "points of the file"],
    );
    for row in table_5_7::rows() {
        let table_5_7::Row { points, method, thesis, ours, linear_predictor, of_points } = row;
        let errors = [thesis, ours, linear_predictor, of_points].map(short);
        let names = [points.to_string(), method.to_owned()];
        table.push(names.into_iter().chain(errors).collect());
    }
    table
}

fn surfaces(which: usize) -> Table {
    let compared = TABLES[which];
    let title = format!(
        "Table {}: average error at the middles of the triangles, problem {}, level {}",
        compared.number, compared.problem.number, compared.level
    );
    let columns =
        ["grid", "nSide", "thesis", "triangles", "ours", "triangles", "linear (VTK)", "triangles"];
    let mut table = Table::new(title, &columns);
    for row in compared.compare(usize::MAX) {
        let mut line = vec![format!("{}³", row.grid), row.points.to_string()];
        for (error, triangles) in [row.thesis, row.ours, row.linear] {
            line.extend([short(error), triangles.to_string()]);
        }
        table.push(line);
    }
    table
}

fn refinement(which: usize) -> Table {
    let tables_of_refinement::Compared { number, problem, what, of, thesis } =
        &tables_of_refinement::TABLES[which];
    let title =
        format!("Table {number}: {what} on problem {problem}, and its ratio to the uniform mesh");
    let columns =
        ["method", "who", "900", "ratio", "1600", "ratio", "2500", "ratio", "3600", "ratio"];
    let mut table = Table::new(title, &columns);
    let ours = tables_of_refinement::rows(*problem).map(|row| row.each_ref().map(of));
    for (n, method) in tables_of_refinement::METHODS.iter().enumerate() {
        for (who, rows) in [("thesis", thesis), ("ours", &ours)] {
            let mut line = vec![method.name().to_owned(), who.to_owned()];
            line.extend((0..4).flat_map(|size| {
                [short(rows[n][size]), format!("{:.2}", rows[0][size] / rows[n][size])]
            }));
            table.push(line);
        }
    }
    table
}
