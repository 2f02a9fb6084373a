//! The command line `vtu2contour`.

fn main() {}
