//! VTK's files: unstructured grids (`.vtu`, `.pvtu`), polygonal data (`.vtp`, `.pvtp`),
//! series (`.pvd`), and both kinds of data in the older format (`.vtk`).
//!
//! This floor knows formats, not mathematics. [`AnyFile`] opens any of them. Reading XML
//! takes every encoding VTK writes: ascii, inline base64, appended base64 and raw;
//! uncompressed, zlib, LZ4 and LZMA; both widths of header words and both byte orders.
//! [`VtuFile`] and [`VtpFile`] map a file, describe it without decoding anything, and decode
//! what is asked for; [`PvtuFile`] and [`PvtpFile`] join the files of pieces or give one at a
//! time; [`PvdFile`] lists the files of a series with their times; [`LegacyFile`] reads the
//! older format. [`write_vtu`] and [`write_vtp`] write through an [`AtomicFile`], so a killed
//! run leaves no half file, and so do the writers of lists: [`write_pvtu`], [`write_pvtp`],
//! [`write_pvd`].
//!
//! Files are not trusted. Before anything is allocated, the sizes that a file promises are
//! checked against each other and against what its bytes can hold; every index is checked
//! once, here, so that the floors above need not.
//!
//! ```text
//!                         any_file
//! pvtu_reader  pvtp_reader  pvd_file           legacy_reader
//!   parallel_file             |     list_writer  legacy_index: sections, cells, arrays
//! vtu_reader  vtp_reader      |  vtu_writer  vtp_writer    legacy_scanner
//!   reading, pieces, points,  |    xml_writer, column        |
//!   cells, joined arrays      |      |                       |
//!     xml_file, array heads --+      |                       |
//!       payload: ascii, base64, block table, compression ----+
//! ```

mod any_file;
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
mod declaration;
mod description;
mod encoding;
mod error;
mod file_bytes;
mod file_names;
mod image_grid;
mod joined_array;
mod joined_section;
mod legacy_array;
mod legacy_cells;
mod legacy_index;
mod legacy_polyhedra;
mod legacy_reader;
mod legacy_scanner;
mod legacy_section;
mod list_writer;
mod offsets;
mod old_hexahedra;
mod parallel_file;
mod payload;
mod piece;
mod pieces;
mod points_reader;
mod poly_data;
mod polyhedra;
mod polyhedra_reader;
mod pvd_file;
mod pvtp_reader;
mod pvtu_reader;
mod reading;
mod scalar;
mod section;
mod selection;
mod unfinished;
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

pub use any_file::{AnyFile, read_grid};
pub use array_type::ArrayType;
pub use atomic_file::{AtomicFile, ClosedFile};
pub use attributes::{AttributeKind, Attributes};
pub use cell_array::CellArray;
pub use data_array::DataArray;
pub use declaration::Declaration;
pub use description::{ArrayInfo, Description};
pub use error::{ArrayError, LegacyProblem, VtkError};
pub use image_grid::{ImageGrid, write_vti_to};
pub use legacy_reader::{LegacyData, LegacyFile};
pub use list_writer::{write_pvd, write_pvd_to, write_pvtp, write_pvtp_to, write_pvtu};
pub use piece::PieceCounts;
pub use poly_data::PolyData;
pub use polyhedra::Polyhedra;
pub use pvd_file::{PvdEntry, PvdFile};
pub use pvtp_reader::PvtpFile;
pub use pvtu_reader::PvtuFile;
pub use reading::Loaded;
pub use selection::Selection;
pub use unfinished::{OutputFolder, abandon_unfinished_files};
pub use unstructured_grid::UnstructuredGrid;
pub use values::Values;
pub use vtp_reader::VtpFile;
pub use vtp_writer::{write_vtp, write_vtp_to};
pub use vtu_reader::VtuFile;
pub use vtu_writer::{write_vtu, write_vtu_to};
pub use write_options::{Encoding, Floats, WriteOptions};
