//! VTK's XML files: unstructured grids (`.vtu`) and polygonal data (`.vtp`).
//!
//! This floor knows formats, not mathematics. Reading takes every encoding VTK writes:
//! ascii, inline base64, appended base64 and raw; uncompressed, zlib, LZ4 and LZMA; both
//! widths of header words and both byte orders. [`VtuFile`] and [`VtpFile`] map a file,
//! describe it without decoding anything, and decode what is asked for; [`write_vtu`] and
//! [`write_vtp`] write through an [`AtomicFile`], so a killed run leaves no half file.
//!
//! Files are not trusted. Before anything is allocated, the sizes that a file promises are
//! checked against each other and against what its bytes can hold; every index is checked
//! once, here, so that the floors above need not.
//!
//! ```text
//! vtu_reader  vtp_reader               vtu_writer  vtp_writer
//!   reading, piece, points, cells,       xml_writer, column
//!   polyhedra, joined arrays               |
//!     xml_file, array heads                |
//!       payload: ascii, base64, block table, compression
//! ```

mod array_head;
mod array_type;
mod ascii;
mod atomic_file;
mod attributes;
mod base64;
mod block_table;
mod cell_array;
mod cell_reader;
mod column;
mod compression;
mod data_array;
mod description;
mod encoding;
mod error;
mod file_bytes;
mod joined_array;
mod joined_section;
mod payload;
mod piece;
mod points_reader;
mod poly_data;
mod polyhedra;
mod polyhedra_reader;
mod reading;
mod scalar;
mod section;
mod selection;
mod unstructured_grid;
mod values;
mod vtp_reader;
mod vtp_writer;
mod vtu_reader;
mod vtu_writer;
mod write_options;
mod writing;
mod xml;
mod xml_file;
mod xml_writer;

pub use array_type::ArrayType;
pub use atomic_file::AtomicFile;
pub use attributes::{AttributeKind, Attributes};
pub use cell_array::CellArray;
pub use data_array::DataArray;
pub use description::{ArrayInfo, Description};
pub use error::{ArrayError, VtkError};
pub use piece::PieceCounts;
pub use poly_data::PolyData;
pub use polyhedra::Polyhedra;
pub use reading::Loaded;
pub use selection::Selection;
pub use unstructured_grid::UnstructuredGrid;
pub use values::Values;
pub use vtp_reader::VtpFile;
pub use vtp_writer::{write_vtp, write_vtp_to};
pub use vtu_reader::VtuFile;
pub use vtu_writer::{write_vtu, write_vtu_to};
pub use write_options::{Encoding, Floats, WriteOptions};
