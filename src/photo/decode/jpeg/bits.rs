//! Bits and Huffman codes of the entropy-coded data of a JPEG (ITU-T T.81, F.2.2 and annex C).

/// Why a code or a number of bits could not be read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Broken {
    /// A marker, or the end of the file, comes before the last bit.
    Ends,
    /// The bits are those of no code, or the code is impossible at its place.
    Code,
}

/// A reader of the bits between two markers.
#[derive(Debug)]
pub(super) struct Bits<'a> {
    bytes: &'a [u8],
    /// Place of the next byte that is not in `buffer`.
    at: usize,
    /// The next bits; the last `count` bits are unread.
    buffer: u64,
    count: u32,
}

impl<'a> Bits<'a> {
    /// The bits of `bytes` from the place `at` to the next marker.
    pub(super) fn new(bytes: &'a [u8], at: usize) -> Self {
        Self { bytes, at, buffer: 0, count: 0 }
    }

    /// Fills the buffer up to the next marker. A byte 0xFF of the data is stored as 0xFF00.
    fn refill(&mut self) {
        while self.count <= 56 {
            let Some(&byte) = self.bytes.get(self.at) else { return };
            let stored_bytes = match (byte, self.bytes.get(self.at + 1)) {
                (0xFF, Some(0)) => 2,
                (0xFF, _) => return,
                _ => 1,
            };
            self.buffer = (self.buffer << 8) | u64::from(byte);
            self.count += 8;
            self.at += stored_bytes;
        }
    }

    /// Reads a number of at most 16 bits.
    pub(super) fn take(&mut self, bits: u32) -> Result<u32, Broken> {
        if self.count < bits {
            self.refill();
        }
        self.count = self.count.checked_sub(bits).ok_or(Broken::Ends)?;
        Ok((self.buffer >> self.count) as u32 & ((1 << bits) - 1))
    }

    /// Reads a code of `table`; returns its symbol.
    pub(super) fn symbol(&mut self, table: &Table) -> Result<u8, Broken> {
        if self.count < LONGEST_CODE {
            self.refill();
        }
        let next = match self.count.checked_sub(LONGEST_CODE) {
            Some(later) => (self.buffer >> later) as u32 & 0xFFFF,
            None => ((self.buffer << (LONGEST_CODE - self.count)) & 0xFFFF) as u32,
        };
        let (length, symbol) = match table.find(next) {
            Some((length, symbol)) if length <= self.count => (length, symbol),
            _ if self.count < LONGEST_CODE => return Err(Broken::Ends),
            _ => return Err(Broken::Code),
        };
        self.count -= length;
        Ok(symbol)
    }

    /// Whether the bits end, as far as they were read, at a restart marker.
    pub(super) fn stops_at_restart(&self) -> bool {
        let mut rest = self.bytes.get(self.at..).unwrap_or_default().iter();
        rest.next() == Some(&0xFF)
            && rest.find(|&&byte| byte != 0xFF).is_some_and(|byte| byte >> 3 == 0xD0 >> 3)
    }

    /// Goes on to the next marker and returns its second byte and the place behind it; `None` at the end of the file. What is
    /// left over of the last byte is skipped, and so are bytes that are all 0 or all 0xFF.
    pub(super) fn next_marker(mut self) -> Result<Option<(u8, usize)>, Broken> {
        self.count -= self.count % 8;
        let (mut any, mut all) = (0, 0xFF);
        loop {
            self.refill();
            if self.count == 0 {
                break;
            }
            let byte = self.take(8)?;
            any |= byte;
            all &= byte;
        }
        if any != 0 && all != 0xFF {
            return Err(Broken::Code);
        }
        let rest = self.bytes.get(self.at..).unwrap_or_default();
        let fill = rest.iter().take_while(|&&byte| byte == 0xFF).count();
        Ok(rest.get(fill).map(|&marker| (marker, self.at + fill + 1)))
    }
}

const LONGEST_CODE: u32 = 16;
/// Number of bits by which most codes are looked up.
const LOOKUP_BITS: u32 = 9;

/// A table of Huffman codes.
#[derive(Debug)]
pub(super) struct Table {
    /// Length and symbol of the code that begins with these bits; length 0: the code is longer, or there is none.
    lookup: Vec<(u8, u8)>,
    /// For each length, the code behind the last one of this length, and what is added to a code to give the place of its symbol.
    ends: [(u32, i32); 17],
    symbols: Vec<u8>,
}

impl Table {
    /// Reads the table at the begin of `content` (B.2.4.2, after the byte of class and number): 16 counts of codes and their
    /// symbols. Returns the rest of `content`; `None` for a table that is cut short or has more codes than fit.
    pub(super) fn read(content: &[u8]) -> Option<(Self, &[u8])> {
        let (counts, rest) = content.split_at_checked(LONGEST_CODE as usize)?;
        let total = counts.iter().map(|&count| usize::from(count)).sum();
        let (symbols, rest) = rest.split_at_checked(total)?;
        let mut lookup = vec![(0, 0); 1 << LOOKUP_BITS];
        let mut ends = [(0, 0); 17];
        let (mut code, mut place) = (0u32, 0usize);
        for (length, &count) in (1..=LONGEST_CODE).zip(counts) {
            ends[length as usize].1 = place as i32 - code as i32;
            for &symbol in &symbols[place..place + usize::from(count)] {
                if code >> length != 0 {
                    return None;
                }
                if length <= LOOKUP_BITS {
                    let first = (code << (LOOKUP_BITS - length)) as usize;
                    lookup[first..first + (1 << (LOOKUP_BITS - length))].fill((length as u8, symbol));
                }
                code += 1;
            }
            place += usize::from(count);
            ends[length as usize].0 = code;
            code <<= 1;
        }
        Some((Self { lookup, ends, symbols: symbols.to_vec() }, rest))
    }

    /// Length and symbol of the code at the begin of the 16 bits `next`.
    fn find(&self, next: u32) -> Option<(u32, u8)> {
        let (length, symbol) = self.lookup[(next >> (LONGEST_CODE - LOOKUP_BITS)) as usize];
        if length > 0 {
            return Some((u32::from(length), symbol));
        }
        (LOOKUP_BITS + 1..=LONGEST_CODE).find_map(|length| {
            let code = next >> (LONGEST_CODE - length);
            let (end, offset) = self.ends[length as usize];
            let place = usize::try_from(code as i32 + offset).ok()?;
            (code < end).then(|| self.symbols.get(place).map(|&symbol| (length, symbol)))?
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Codes 0, 10, 110 and, of ten bits, 1110000000.
    fn table() -> Table {
        let content = [&[1, 1, 1, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0], &b"abcd"[..]].concat();
        Table::read(&content).unwrap().0
    }

    #[test]
    fn codes_of_any_length_are_read_up_to_a_marker() {
        let mut bits = Bits::new(&[0b0101_1011, 0b1000_0000, 0xFF, 0xD0], 0);
        for expected in *b"abcd" {
            assert_eq!(bits.symbol(&table()), Ok(expected));
        }
        assert_eq!(bits.next_marker(), Ok(Some((0xD0, 4))));
        let mut ones = Bits::new(&[0xFF, 0, 0xFF, 0, 0xFF, 0xD9], 0);
        assert_eq!(ones.symbol(&table()), Err(Broken::Code));
        assert_eq!(ones.take(15).and_then(|_| ones.take(2)), Err(Broken::Ends));
        assert_eq!(Bits::new(&[0xFF, 0], 0).symbol(&table()), Err(Broken::Ends));
        assert_eq!(Bits::new(&[1, 2, 0xFF, 0xD9], 0).next_marker(), Err(Broken::Code));
        assert_eq!(Bits::new(&[0, 0, 0xFF, 0xFF, 0xD9], 0).next_marker(), Ok(Some((0xD9, 5))));
        assert_eq!(Bits::new(&[], 0).next_marker(), Ok(None));
    }

    #[test]
    fn a_table_of_too_many_codes_is_none() {
        let content = [&[3, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0], &b"abc"[..]].concat();
        assert!(Table::read(&content).is_none() && Table::read(&content[..9]).is_none());
    }
}
