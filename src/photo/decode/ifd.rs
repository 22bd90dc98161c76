//! Reads image file directories (TIFF 6.0, section 2, and `BigTIFF`), which TIFF files and EXIF blocks consist of.

use crate::photo::error::Fault;

/// The bytes of a file of directories, and how its numbers are stored.
#[derive(Clone, Copy, Debug)]
pub(super) struct IfdFile<'a> {
    pub bytes: &'a [u8],
    pub big_endian: bool,
    /// Whether positions have 64 bits (`BigTIFF`).
    big: bool,
}

/// One directory: fields by their tags.
#[derive(Clone, Debug)]
pub(super) struct Directory<'a> {
    pub file: IfdFile<'a>,
    fields: Vec<Field>,
    /// Tags of fields whose values lie outside of the file.
    outside: Vec<u16>,
    /// Position of the next directory, 0 behind the last one; `None` where the file ends before it.
    pub next: Option<u64>,
}

/// A field of a directory, whose value lies inside of the file.
#[derive(Clone, Copy, Debug)]
struct Field {
    tag: u16,
    kind: u16,
    count: usize,
    /// Position of the value.
    at: usize,
}

/// Number of bytes of a value of each type, by the type's number; 0 for numbers without a type.
const VALUE_BYTES: [usize; 19] = [0, 1, 1, 2, 4, 8, 1, 1, 2, 4, 8, 4, 8, 4, 0, 0, 8, 8, 8];

impl<'a> IfdFile<'a> {
    /// Reads the header.
    pub(super) fn of(bytes: &'a [u8]) -> Result<Self, Fault> {
        let mut file = Self { bytes, big_endian: bytes.starts_with(b"MM"), big: false };
        file.big = match file.number(2, 2) {
            Some(42) => false,
            Some(43) => true,
            _ => return Err(Fault::damaged("its header is cut short")),
        };
        Ok(file)
    }

    /// Position of the first directory.
    pub(super) fn first(&self) -> Result<u64, Fault> {
        let at = if self.big { self.number(8, 8) } else { self.number(4, 4) };
        at.ok_or_else(|| Fault::damaged("its header is cut short"))
    }

    /// The directory at a position. Fields of unknown types, and fields whose values lie outside of the file, have no values.
    pub(super) fn directory(&self, at: u64) -> Result<Directory<'a>, Fault> {
        let cut = || Fault::damaged("its directory is cut short");
        let (count_bytes, field_bytes, inline_bytes) = if self.big { (8, 20, 8) } else { (2, 12, 4) };
        let at = usize::try_from(at).map_err(|_| cut())?;
        let count = self.number(at, count_bytes).ok_or_else(cut)?;
        let first = at.checked_add(count_bytes).ok_or_else(cut)?;
        let count = usize::try_from(count).map_err(|_| cut())?;
        let end =
            count.checked_mul(field_bytes).and_then(|bytes| bytes.checked_add(first)).ok_or_else(cut)?;
        if end > self.bytes.len() {
            return Err(cut());
        }
        let field = |at: usize| -> Option<Field> {
            let tag = self.number(at, 2)? as u16;
            let kind = self.number(at + 2, 2)? as u16;
            let count = usize::try_from(self.number(at + 4, inline_bytes)?).ok()?;
            let each = *VALUE_BYTES.get(usize::from(kind)).filter(|&&bytes| bytes > 0)?;
            let length = count.checked_mul(each)?;
            let inline = at + 4 + inline_bytes;
            let at = if length <= inline_bytes {
                inline
            } else {
                usize::try_from(self.number(inline, inline_bytes)?).ok()?
            };
            Some(Field { tag, kind, count, at })
        };
        let fields = (0..count).filter_map(|index| field(first + index * field_bytes));
        let is_inside = |field: &Field| {
            let length = field.count * VALUE_BYTES[usize::from(field.kind)];
            field.at.checked_add(length).is_some_and(|end| end <= self.bytes.len())
        };
        let (fields, outside): (Vec<Field>, Vec<Field>) = fields.partition(is_inside);
        let outside = outside.into_iter().map(|field| field.tag).collect();
        Ok(Directory { file: *self, fields, outside, next: self.number(end, inline_bytes) })
    }

    /// The unsigned integer of `length` bytes at `at`.
    fn number(&self, at: usize, length: usize) -> Option<u64> {
        let field = self.bytes.get(at..at.checked_add(length)?)?;
        let append = |number: u64, &byte: &u8| (number << 8) | u64::from(byte);
        Some(if self.big_endian { field.iter().fold(0, append) } else { field.iter().rev().fold(0, append) })
    }
}

impl<'a> Directory<'a> {
    fn field(&self, tag: u16) -> Option<Field> {
        self.fields.iter().copied().find(|field| field.tag == tag)
    }

    /// Fails where the value of a field that a reader knows lies outside of the file.
    pub(super) fn expect_inside(&self, is_known: impl Fn(u16) -> bool) -> Result<(), Fault> {
        match self.outside.iter().find(|&&tag| is_known(tag)) {
            Some(tag) => {
                Err(Fault::damaged(format!("the value of its field {tag} lies outside of the file")))
            }
            None => Ok(()),
        }
    }

    /// Whether the directory has a field.
    pub(super) fn has(&self, tag: u16) -> bool {
        self.field(tag).is_some()
    }

    /// The values of a field of integers, of which negative ones are left out; empty where the directory lacks the field.
    pub(super) fn integers(&self, tag: u16) -> Vec<u64> {
        let Some(field) = self.field(tag) else { return Vec::new() };
        let each = match field.kind {
            1 | 3 | 4 | 6 | 7 | 8 | 9 | 13 | 16 | 17 | 18 => VALUE_BYTES[usize::from(field.kind)],
            _ => return Vec::new(),
        };
        let is_signed = matches!(field.kind, 6 | 8 | 9 | 17);
        let value = |index: usize| self.file.number(field.at + index * each, each);
        let is_negative = |value: &u64| is_signed && value >> (8 * each - 1) != 0;
        (0..field.count).filter_map(value).filter(|value| !is_negative(value)).collect()
    }

    /// The first value of a field of integers.
    pub(super) fn integer(&self, tag: u16) -> Option<u64> {
        self.integers(tag).first().copied()
    }

    /// The bytes of a field.
    pub(super) fn bytes(&self, tag: u16) -> Option<&'a [u8]> {
        let field = self.field(tag)?;
        self.file.bytes.get(field.at..field.at + field.count * VALUE_BYTES[usize::from(field.kind)])
    }

    /// Numerators and denominators of a field of unsigned fractions.
    pub(super) fn fractions(&self, tag: u16) -> Vec<(u32, u32)> {
        let Some(field) = self.field(tag).filter(|field| field.kind == 5) else { return Vec::new() };
        let part = |at| self.file.number(at, 4).map(|number| number as u32);
        (0..field.count)
            .filter_map(|index| Some((part(field.at + 8 * index)?, part(field.at + 8 * index + 4)?)))
            .collect()
    }

    /// Numbers of a field of unsigned fractions.
    pub(super) fn quotients(&self, tag: u16) -> Vec<f64> {
        self.fractions(tag).into_iter().map(|(over, under)| f64::from(over) / f64::from(under)).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fields_outside_of_the_file_are_left_out() {
        let mut bytes = b"II*\0\x08\0\0\0\x03\0".to_vec();
        bytes.extend_from_slice(&[0, 1, 3, 0, 1, 0, 0, 0, 7, 0, 0, 0]);
        bytes.extend_from_slice(&[1, 1, 4, 0, 2, 0, 0, 0, 0xFF, 0, 0, 0]);
        bytes.extend_from_slice(&[2, 1, 99, 0, 1, 0, 0, 0, 7, 0, 0, 0]);
        let file = IfdFile::of(&bytes).unwrap();
        let directory = file.directory(file.first().unwrap()).unwrap();
        assert_eq!((directory.integer(256), directory.next), (Some(7), None));
        assert!(!directory.has(257) && !directory.has(258));
        assert!(directory.expect_inside(|tag| tag == 257).is_err());
        assert!(directory.expect_inside(|tag| tag != 257).is_ok());
        assert!(file.directory(9999).is_err() && IfdFile::of(b"II").is_err());
    }
}
