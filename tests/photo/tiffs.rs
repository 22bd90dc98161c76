//! A writer of TIFF files of any arrangement, field by field.

/// The fields of a page besides those of its size and strips, and its strips or tiles.
#[derive(Clone, Default)]
pub struct Page {
    pub size: (u32, u32),
    /// Bits of each band.
    pub bits: Vec<u16>,
    pub photometric: u16,
    /// Further fields of 16-bit numbers.
    pub shorts: Vec<(u16, Vec<u16>)>,
    /// Further fields of unsigned fractions: numerators and denominators in turn.
    pub fractions: Vec<(u16, Vec<u32>)>,
    /// Further fields of text.
    pub texts: Vec<(u16, &'static str)>,
    /// Columns and rows of a tile; `None` for strips.
    pub tile: Option<(u32, u32)>,
    /// Rows of a strip; 0 for all.
    pub strip_rows: u32,
    /// The bytes of the strips or tiles.
    pub chunks: Vec<Vec<u8>>,
}

impl Page {
    /// One strip of samples of `bits` bits, as many bands as the photometric interpretation needs.
    pub fn new(size: (u32, u32), bits: u16, photometric: u16, data: &[u8]) -> Self {
        let bands = if matches!(photometric, 2 | 6) { 3 } else { 1 };
        Self { size, bits: vec![bits; bands], photometric, chunks: vec![data.to_vec()], ..Self::default() }
    }

    /// The page with a further field.
    pub fn with(mut self, tag: u16, values: &[u16]) -> Self {
        self.shorts.push((tag, values.to_vec()));
        self
    }
}

/// The bytes of a little-endian or big-endian file of pages.
pub fn file(pages: &[Page], big_endian: bool) -> Vec<u8> {
    let mut writer = Writer { bytes: Vec::new(), big_endian };
    writer.bytes.extend_from_slice(if big_endian { b"MM" } else { b"II" });
    writer.short(42);
    let mut pointer = writer.bytes.len();
    writer.long(0);
    for page in pages {
        pointer = writer.page(page, pointer);
    }
    writer.bytes
}

struct Writer {
    bytes: Vec<u8>,
    big_endian: bool,
}

impl Writer {
    fn short(&mut self, value: u16) {
        self.bytes.extend(if self.big_endian { value.to_be_bytes() } else { value.to_le_bytes() });
    }

    fn long(&mut self, value: u32) {
        self.bytes.extend(if self.big_endian { value.to_be_bytes() } else { value.to_le_bytes() });
    }

    /// Writes chunks, values and directory; `pointer` is where the position of the directory belongs. Returns where that of
    /// the next directory belongs.
    fn page(&mut self, page: &Page, pointer: usize) -> usize {
        let (mut offsets, mut counts) = (Vec::new(), Vec::new());
        for chunk in &page.chunks {
            offsets.push(self.bytes.len() as u32);
            counts.push(chunk.len() as u32);
            self.bytes.extend_from_slice(chunk);
            self.bytes.resize(self.bytes.len().next_multiple_of(2), 0);
        }
        let (at_offsets, at_counts) = if page.tile.is_some() { (324, 325) } else { (273, 279) };
        let mut longs = vec![(256, vec![page.size.0]), (257, vec![page.size.1]), (at_offsets, offsets)];
        longs.push((at_counts, counts));
        match page.tile {
            Some((columns, rows)) => longs.extend([(322, vec![columns]), (323, vec![rows])]),
            None if page.strip_rows > 0 => longs.push((278, vec![page.strip_rows])),
            None => {}
        }
        let mut shorts = page.shorts.clone();
        shorts.extend([(258, page.bits.clone()), (262, vec![page.photometric])]);
        shorts.push((277, vec![page.bits.len() as u16]));
        // Tag, type, count, and the bytes of the value.
        let mut fields: Vec<(u16, u16, u32, Vec<u8>)> = Vec::new();
        let mut scratch = Self { bytes: Vec::new(), big_endian: self.big_endian };
        for (tag, values) in longs {
            for &value in &values {
                scratch.long(value);
            }
            fields.push((tag, 4, values.len() as u32, std::mem::take(&mut scratch.bytes)));
        }
        for (tag, values) in shorts {
            for &value in &values {
                scratch.short(value);
            }
            fields.push((tag, 3, values.len() as u32, std::mem::take(&mut scratch.bytes)));
        }
        for (tag, values) in &page.fractions {
            for &value in values {
                scratch.long(value);
            }
            fields.push((*tag, 5, values.len() as u32 / 2, std::mem::take(&mut scratch.bytes)));
        }
        for (tag, text) in &page.texts {
            let text = [text.as_bytes(), &[0]].concat();
            fields.push((*tag, 2, text.len() as u32, text));
        }
        fields.sort_by_key(|field| field.0);
        self.directory(fields, pointer)
    }

    fn directory(&mut self, fields: Vec<(u16, u16, u32, Vec<u8>)>, pointer: usize) -> usize {
        let mut inline = Vec::new();
        for (_, _, _, value) in &fields {
            if value.len() <= 4 {
                let mut padded = value.clone();
                padded.resize(4, 0);
                inline.push(padded);
            } else {
                let at = self.bytes.len() as u32;
                self.bytes.extend_from_slice(value);
                self.bytes.resize(self.bytes.len().next_multiple_of(2), 0);
                let order = if self.big_endian { at.to_be_bytes() } else { at.to_le_bytes() };
                inline.push(order.to_vec());
            }
        }
        let at = self.bytes.len() as u32;
        let order = if self.big_endian { at.to_be_bytes() } else { at.to_le_bytes() };
        self.bytes[pointer..pointer + 4].copy_from_slice(&order);
        self.short(fields.len() as u16);
        for ((tag, kind, count, _), value) in fields.into_iter().zip(inline) {
            self.short(tag);
            self.short(kind);
            self.long(count);
            self.bytes.extend(value);
        }
        let next = self.bytes.len();
        self.long(0);
        next
    }
}
