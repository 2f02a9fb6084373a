//! What several tests need: meshes, fields, and a brute-force contour.
#![allow(dead_code)] // each test binary uses a part

pub mod brute_force;
pub mod cells;
pub mod meshes;
pub mod problem4;
pub mod table_5_7;
