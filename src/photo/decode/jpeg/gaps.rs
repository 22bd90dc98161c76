//! Walks the entropy-coded data of a JPEG (ITU-T T.81, annexes F and G) without computing a sample, and finds missing blocks.
//!
//! The decoding libraries fill in what is missing behind an early end, and take the restart marker that follows a gap for the
//! next one, both without a word. The walk reads every code, which takes less time than the decoding, and finds the first
//! place at which the data and the header contradict each other.

use super::bits::{Bits, Broken, Table};
use super::header::{Component, Header};
use std::fmt;

/// What is wrong with the data of a JPEG, found first.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::photo::decode) enum Gap {
    /// The data end before the last block. Rows from this one on are filled in.
    EndsEarly(u32),
    /// Codes are wrong, left over, or not where the restart markers say, from this row on.
    Damaged(u32),
    /// Scans are missing.
    Scans,
}

impl fmt::Display for Gap {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::EndsEarly(row) => {
                write!(f, "the JPEG's data end early: the picture from row {row} on is filled in")
            }
            Self::Damaged(row) => {
                write!(
                    f,
                    "the JPEG's data are damaged: the picture from row {row} on may be wrong or displaced"
                )
            }
            Self::Scans => {
                write!(f, "the JPEG lacks its last scans: the picture is coarser than it should be")
            }
        }
    }
}

/// The first gap in the data of the file `bytes`, whose markers say `header`.
pub(super) fn first_gap(bytes: &[u8], header: &Header) -> Option<Gap> {
    Walk::new(bytes, header).run().err()
}

/// Number of coefficients of a block.
const COEFFICIENTS: usize = 64;
/// Depth of a coefficient that no scan has coded.
const UNSEEN: u8 = u8::MAX;

/// The blocks of a component.
struct Plane {
    id: u8,
    /// Sampling factors, across and down.
    factors: (u32, u32),
    /// Number of blocks across and down that hold pixels: those of a scan of the component alone.
    own: (u32, u32),
    /// Number of blocks across in a scan of several components.
    padded_across: u32,
    /// In a progressive file, for each block of a scan of several components, the coefficients that are not 0, as bits.
    nonzero: Vec<u64>,
    /// Lowest bit that was coded of each coefficient.
    depth: [u8; COEFFICIENTS],
}

impl Plane {
    fn all(header: &Header) -> Vec<Self> {
        let largest = header.largest_factors();
        let mcus = (header.width.div_ceil(8 * largest.0), header.height.div_ceil(8 * largest.1));
        let plane = |component: &Component| {
            let factors = (component.across, component.down);
            let padded = (mcus.0 * factors.0, mcus.1 * factors.1);
            let marked = if header.is_progressive() { padded.0 as usize * padded.1 as usize } else { 0 };
            Self {
                id: component.id,
                factors,
                own: (
                    (header.width * factors.0).div_ceil(largest.0 * 8),
                    (header.height * factors.1).div_ceil(largest.1 * 8),
                ),
                padded_across: padded.0,
                nonzero: vec![0; marked],
                depth: [UNSEEN; COEFFICIENTS],
            }
        };
        header.components.iter().map(plane).collect()
    }
}

/// One component of a scan: its number among the planes, and its tables.
struct Part {
    plane: usize,
    dc: usize,
    ac: usize,
}

/// What the blocks of a scan hold.
#[derive(Clone, Copy)]
enum Pass {
    /// All coefficients, in a file that is not progressive.
    Sequential,
    DcFirst,
    DcRefined,
    /// The coefficients of this range.
    AcFirst(usize, usize),
    AcRefined(usize, usize),
}

struct Walk<'a> {
    bytes: &'a [u8],
    header: &'a Header,
    planes: Vec<Plane>,
    dc: [Option<Table>; 4],
    ac: [Option<Table>; 4],
    /// Number of units between restart markers; 0: none.
    restart_interval: u32,
}

impl<'a> Walk<'a> {
    fn new(bytes: &'a [u8], header: &'a Header) -> Self {
        let (dc, ac) = Default::default();
        Self { bytes, header, planes: Plane::all(header), dc, ac, restart_interval: 0 }
    }

    fn run(mut self) -> Result<(), Gap> {
        // The search starts after the start-of-image marker of two bytes, as that of `Header::of_file`.
        let mut at = 2;
        while let Some((marker, behind)) = next_marker(self.bytes, at) {
            at = behind;
            match marker {
                0xD9 => break,
                0x00 | 0x01 | 0xD0..=0xD8 => continue,
                _ => {}
            }
            let length =
                self.bytes.get(at..at + 2).map_or(2, |bytes| u16::from_be_bytes([bytes[0], bytes[1]]));
            let end = (at + usize::from(length)).max(at + 2);
            let content = self.bytes.get(at + 2..end).unwrap_or_default();
            at = end;
            match (marker, content) {
                (0xC4, _) => self.read_tables(content),
                (0xDD, [high, low, ..]) => {
                    self.restart_interval = u32::from(u16::from_be_bytes([*high, *low]));
                }
                (0xDA, _) => self.walk_scan(content, at)?,
                _ => {}
            }
        }
        let complete = self.planes.iter().all(|plane| plane.depth == [0; COEFFICIENTS]);
        if complete { Ok(()) } else { Err(Gap::Scans) }
    }

    fn read_tables(&mut self, mut content: &[u8]) {
        while let Some((&kind, after)) = content.split_first() {
            let Some((table, rest)) = Table::read(after) else { return };
            let tables = if kind >> 4 == 0 { &mut self.dc } else { &mut self.ac };
            tables[usize::from(kind & 3)] = Some(table);
            content = rest;
        }
    }

    /// Walks the scan whose header is `content` and whose data begin at `at`.
    fn walk_scan(&mut self, content: &[u8], at: usize) -> Result<(), Gap> {
        let damaged = Gap::Damaged(0);
        let (&count, rest) = content.split_first().ok_or(damaged)?;
        let (entries, rest) = rest.split_at_checked(2 * usize::from(count)).ok_or(damaged)?;
        let part = |entry: &[u8]| {
            let plane = self.planes.iter().position(|plane| plane.id == entry[0])?;
            Some(Part { plane, dc: usize::from(entry[1] >> 4 & 3), ac: usize::from(entry[1] & 3) })
        };
        let parts: Vec<Part> = entries.chunks_exact(2).map(part).collect::<Option<_>>().ok_or(damaged)?;
        let &[first, last, bits, ..] = rest else { return Err(damaged) };
        let (first, last) = (usize::from(first), usize::from(last).min(COEFFICIENTS - 1));
        let pass = match (self.header.is_progressive(), first, bits >> 4) {
            (false, ..) => Pass::Sequential,
            (true, 0, 0) => Pass::DcFirst,
            (true, 0, _) => Pass::DcRefined,
            (true, _, 0) => Pass::AcFirst(first, last),
            _ => Pass::AcRefined(first, last),
        };
        if parts.is_empty() || first > last || (first > 0 && parts.len() > 1) {
            return Err(damaged);
        }
        let coded = match pass {
            Pass::Sequential => 0..=COEFFICIENTS - 1,
            _ => first..=last,
        };
        let depth = if self.header.is_progressive() { bits & 15 } else { 0 };
        for part in &parts {
            self.planes[part.plane].depth[coded.clone()].fill(depth);
        }
        self.walk_units(&parts, pass, at)
    }

    /// Walks all units of a scan: blocks of its only component, or groups of blocks of several (A.2).
    fn walk_units(&mut self, parts: &[Part], pass: Pass, at: usize) -> Result<(), Gap> {
        let largest = self.header.largest_factors();
        let (across, down, unit_rows) = if let [alone] = parts {
            let plane = &self.planes[alone.plane];
            (plane.own.0, plane.own.1, 8 * largest.1 / plane.factors.1)
        } else {
            let size = (8 * largest.0, 8 * largest.1);
            (self.header.width.div_ceil(size.0), self.header.height.div_ceil(size.1), size.1)
        };
        let mut bits = Bits::new(self.bytes, at);
        let mut end_of_bands = 0;
        for unit in 0..across * down {
            let (x, y) = (unit % across, unit / across);
            let row = y * unit_rows;
            if self.restart_interval > 0 && unit > 0 && unit % self.restart_interval == 0 {
                let number = (unit / self.restart_interval - 1) % 8;
                match bits.next_marker() {
                    Ok(Some((marker, at))) if marker == 0xD0 + number as u8 => {
                        bits = Bits::new(self.bytes, at);
                    }
                    Ok(Some((0xD0..=0xD7, _))) | Err(_) => return Err(Gap::Damaged(row)),
                    Ok(_) => return Err(Gap::EndsEarly(row)),
                }
                end_of_bands = 0;
            }
            let walked = self.walk_unit(parts, pass, (x, y), &mut bits, &mut end_of_bands);
            walked.map_err(|broken| match broken {
                // The data behind a restart marker are there, so that the data before the marker have a hole.
                Broken::Ends if !bits.stops_at_restart() => Gap::EndsEarly(row),
                _ => Gap::Damaged(row),
            })?;
        }
        let last_row = down.saturating_sub(1) * unit_rows;
        bits.next_marker().map(|_| ()).map_err(|_| Gap::Damaged(last_row))
    }

    fn walk_unit(
        &mut self,
        parts: &[Part],
        pass: Pass,
        (x, y): (u32, u32),
        bits: &mut Bits,
        end_of_bands: &mut u32,
    ) -> Result<(), Broken> {
        for part in parts {
            let plane = &mut self.planes[part.plane];
            let (across, down) = if parts.len() == 1 { (1, 1) } else { plane.factors };
            for block in 0..across * down {
                let column = x * across + block % across;
                let row = y * down + block / across;
                let place = row as usize * plane.padded_across as usize + column as usize;
                let (dc, ac) = (self.dc[part.dc].as_ref(), self.ac[part.ac].as_ref());
                match pass {
                    Pass::Sequential => {
                        walk_dc(bits, dc)?;
                        walk_sequential_ac(bits, ac)?;
                    }
                    Pass::DcFirst => walk_dc(bits, dc)?,
                    Pass::DcRefined => drop(bits.take(1)?),
                    Pass::AcFirst(first, last) => {
                        let nonzero = plane.nonzero.get_mut(place).ok_or(Broken::Code)?;
                        walk_first_ac(bits, ac, (first, last), nonzero, end_of_bands)?;
                    }
                    Pass::AcRefined(first, last) => {
                        let nonzero = plane.nonzero.get_mut(place).ok_or(Broken::Code)?;
                        walk_refined_ac(bits, ac, (first, last), nonzero, end_of_bands)?;
                    }
                }
            }
        }
        Ok(())
    }
}

/// Second byte of the next marker from `at` on, and the place behind it.
fn next_marker(bytes: &[u8], at: usize) -> Option<(u8, usize)> {
    let start = at + bytes.get(at..)?.iter().position(|&byte| byte == 0xFF)?;
    let marker_at = start + bytes[start..].iter().position(|&byte| byte != 0xFF)?;
    Some((bytes[marker_at], marker_at + 1))
}

/// The difference of a DC coefficient (F.2.2.1).
fn walk_dc(bits: &mut Bits, table: Option<&Table>) -> Result<(), Broken> {
    let size = bits.symbol(table.ok_or(Broken::Code)?)?;
    if size > 15 {
        return Err(Broken::Code);
    }
    bits.take(u32::from(size)).map(drop)
}

/// The AC coefficients of a block (F.2.2.2).
fn walk_sequential_ac(bits: &mut Bits, table: Option<&Table>) -> Result<(), Broken> {
    let table = table.ok_or(Broken::Code)?;
    let mut at = 1;
    while at < COEFFICIENTS {
        let symbol = bits.symbol(table)?;
        let (run, size) = (usize::from(symbol >> 4), u32::from(symbol & 15));
        match (run, size) {
            (15, 0) => at += 16,
            (_, 0) => return Ok(()),
            _ => {
                at += run + 1;
                bits.take(size)?;
            }
        }
    }
    if at > COEFFICIENTS { Err(Broken::Code) } else { Ok(()) }
}

/// The first bits of the AC coefficients `first` to `last` of a block (G.1.2.2).
fn walk_first_ac(
    bits: &mut Bits,
    table: Option<&Table>,
    (first, last): (usize, usize),
    nonzero: &mut u64,
    end_of_bands: &mut u32,
) -> Result<(), Broken> {
    if *end_of_bands > 0 {
        *end_of_bands -= 1;
        return Ok(());
    }
    let table = table.ok_or(Broken::Code)?;
    let mut at = first;
    while at <= last {
        let symbol = bits.symbol(table)?;
        let (run, size) = (symbol >> 4, u32::from(symbol & 15));
        match (run, size) {
            (15, 0) => at += 16,
            (_, 0) => {
                *end_of_bands = (1 << run) - 1 + bits.take(u32::from(run))?;
                return Ok(());
            }
            _ => {
                at += usize::from(run);
                if at > last {
                    return Err(Broken::Code);
                }
                bits.take(size)?;
                *nonzero |= 1 << at;
                at += 1;
            }
        }
    }
    Ok(())
}

/// A further bit of the AC coefficients `first` to `last` of a block (G.1.2.3).
fn walk_refined_ac(
    bits: &mut Bits,
    table: Option<&Table>,
    (first, last): (usize, usize),
    nonzero: &mut u64,
    end_of_bands: &mut u32,
) -> Result<(), Broken> {
    let table = table.ok_or(Broken::Code)?;
    let mut at = first;
    if *end_of_bands == 0 {
        while at <= last {
            let symbol = bits.symbol(table)?;
            let (mut zeros, size) = (symbol >> 4, symbol & 15);
            match (zeros, size) {
                (0..15, 0) => {
                    *end_of_bands = (1 << zeros) + bits.take(u32::from(zeros))?;
                    break;
                }
                (_, 0) => {}
                // The sign of a coefficient that is no longer 0.
                (_, 1) => drop(bits.take(1)?),
                _ => return Err(Broken::Code),
            }
            // Every coefficient that was not 0 has a bit, until the run of zeros is over.
            while at <= last {
                if *nonzero >> at & 1 == 1 {
                    bits.take(1)?;
                } else if zeros == 0 {
                    break;
                } else {
                    zeros -= 1;
                }
                at += 1;
            }
            if size == 1 {
                if at > last {
                    return Err(Broken::Code);
                }
                *nonzero |= 1 << at;
            }
            at += 1;
        }
    }
    if *end_of_bands > 0 {
        while at <= last {
            if *nonzero >> at & 1 == 1 {
                bits.take(1)?;
            }
            at += 1;
        }
        *end_of_bands -= 1;
    }
    Ok(())
}
