//! What several tests need: meshes, fields, and a brute-force contour.
#![allow(dead_code)] // each test binary uses a part

pub mod brute_force;
pub mod brute_force_3d;
pub mod cells;
pub mod checked;
pub mod delaunay_3d;
pub mod distance;
pub mod domains;
pub mod meshes;
pub mod mixed_grid;
pub mod order;
pub mod p1;
pub mod polynomial;
pub mod problem4;
pub mod problems_3d;
pub mod reference;
pub mod sampling;
pub mod surfaces;
pub mod table;
pub mod table_5_1;
pub mod table_5_3;
pub mod table_5_7;
pub mod tables_of_refinement;
pub mod tables_of_surfaces;
pub mod tetrahedra;
