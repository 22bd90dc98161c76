//! Writes pictures as arrays of `NumPy` (format version 1.0): 32-bit floats, rows first.

use super::ExportError;
use crate::photo::COUNTS_PER_UNIT;
use crate::raster::Raster;
use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::Path;

/// Size that the header is a multiple of, bytes.
const ALIGNMENT: usize = 64;

/// Writes counts as an array of rows, columns and bands.
pub(super) fn write_rgb(path: &Path, counts: &Raster<[f32; 3]>) -> Result<(), ExportError> {
    let shape = format!("({}, {}, 3)", counts.height(), counts.width());
    write(path, &shape, counts.as_slice().as_flattened())
}

/// Writes counts as an array of rows and columns.
pub(super) fn write_single(path: &Path, counts: &Raster<f32>) -> Result<(), ExportError> {
    write(path, &format!("({}, {})", counts.height(), counts.width()), counts.as_slice())
}

/// The bytes of an array of rows, columns and bands.
pub(super) fn rgb_bytes(counts: &Raster<[f32; 3]>) -> Vec<u8> {
    let shape = format!("({}, {}, 3)", counts.height(), counts.width());
    bytes(&shape, counts.as_slice().as_flattened())
}

/// The bytes of an array of rows and columns.
pub(super) fn single_bytes(counts: &Raster<f32>) -> Vec<u8> {
    bytes(&format!("({}, {})", counts.height(), counts.width()), counts.as_slice())
}

fn bytes(shape: &str, counts: &[f32]) -> Vec<u8> {
    let values = counts.iter().flat_map(|value| (value / COUNTS_PER_UNIT).to_le_bytes());
    header(shape).into_iter().chain(values).collect()
}

fn write(path: &Path, shape: &str, counts: &[f32]) -> Result<(), ExportError> {
    let failed = |source| ExportError::Io { path: path.to_owned(), source };
    let mut file = BufWriter::new(File::create(path).map_err(failed)?);
    let written = file.write_all(&header(shape)).and_then(|()| {
        for value in counts {
            file.write_all(&(value / COUNTS_PER_UNIT).to_le_bytes())?;
        }
        file.flush()
    });
    written.map_err(failed)
}

/// Signature, version, length of the text, and a text that describes the array and ends with a line end.
fn header(shape: &str) -> Vec<u8> {
    let mut text = format!("{{'descr': '<f4', 'fortran_order': False, 'shape': {shape}, }}");
    let unpadded = 10 + text.len() + 1;
    text.push_str(&" ".repeat(unpadded.next_multiple_of(ALIGNMENT) - unpadded));
    text.push('\n');
    let mut header = b"\x93NUMPY\x01\0".to_vec();
    header.extend_from_slice(&(text.len() as u16).to_le_bytes());
    header.extend_from_slice(text.as_bytes());
    header
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_array_has_a_padded_header_and_linear_values() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.npy");
        write_single(&path, &Raster::from_vec(2, 1, vec![255.0, -51.0]).unwrap()).unwrap();
        let bytes = std::fs::read(&path).unwrap();
        assert_eq!((&bytes[..8], bytes.len()), (&b"\x93NUMPY\x01\0"[..], 128 + 8));
        assert_eq!(usize::from(u16::from_le_bytes([bytes[8], bytes[9]])), 128 - 10);
        assert!(String::from_utf8_lossy(&bytes[10..128]).contains("'shape': (1, 2), }"));
        assert_eq!(bytes[128..], [1.0f32.to_le_bytes(), (-0.2f32).to_le_bytes()].concat());
    }
}
