//! A photograph's colours in 64³ bins, and the way from a bin to its pixels and back.

use crate::photo::LinearImage;

/// Bins along each band.
pub const BINS_PER_BAND: usize = 64;

/// The colours of a photograph, binned; only bins that hold pixels are kept.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Histogram {
    /// Counts that the bins of each band span, from 0; brighter colours are in the last bin.
    pub full_counts: f32,
    /// The bins, in the order of their place in the cube.
    pub bins: Vec<ColourBin>,
    /// Bin of each pixel.
    of_pixel: Vec<u32>,
    /// Pixels ordered by bin.
    pixels: Vec<u32>,
}

/// One bin that holds pixels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ColourBin {
    /// Mean colour of its pixels, linear counts.
    pub mean: [f32; 3],
    /// How many they are.
    pub count: u32,
    /// Where they begin in the order by bin.
    first: u32,
}

impl Histogram {
    /// Bins the colours of `image`: two passes over memory.
    pub fn of(image: &LinearImage) -> Self {
        let colours = image.pixels.as_slice();
        let brightest = colours.iter().flatten().fold(0.0f32, |most, &v| most.max(v));
        let full_counts = image.saturation.unwrap_or(0.0).max(brightest).max(1.0);
        let per_count = BINS_PER_BAND as f32 / full_counts;
        let place = |colour: [f32; 3]| {
            let [r, g, b] = colour.map(|v| ((v * per_count) as usize).min(BINS_PER_BAND - 1));
            (r * BINS_PER_BAND + g) * BINS_PER_BAND + b
        };
        let mut counts = vec![0u32; BINS_PER_BAND.pow(3)];
        let mut of_pixel: Vec<u32> = Vec::with_capacity(colours.len());
        for &colour in colours {
            let cell = place(colour);
            counts[cell] += 1;
            of_pixel.push(cell as u32);
        }
        let mut number = vec![0u32; counts.len()];
        let mut bins = Vec::new();
        let mut first = 0;
        for (number, &count) in number.iter_mut().zip(&counts).filter(|(_, count)| **count > 0) {
            *number = bins.len() as u32;
            bins.push(ColourBin { mean: [0.0; 3], count, first });
            first += count;
        }
        let mut next: Vec<u32> = bins.iter().map(|bin| bin.first).collect();
        let mut sums = vec![[0.0f64; 3]; bins.len()];
        let mut pixels = vec![0u32; colours.len()];
        for (pixel, (bin, &colour)) in of_pixel.iter_mut().zip(colours).enumerate() {
            *bin = number[*bin as usize];
            let slot = *bin as usize;
            pixels[next[slot] as usize] = pixel as u32;
            next[slot] += 1;
            for (sum, v) in sums[slot].iter_mut().zip(colour) {
                *sum += f64::from(v);
            }
        }
        for (bin, sum) in bins.iter_mut().zip(sums) {
            bin.mean = sum.map(|v| (v / f64::from(bin.count)) as f32);
        }
        Self { full_counts, bins, of_pixel, pixels }
    }

    /// The bin that a pixel is in.
    pub fn bin_of(&self, pixel: usize) -> Option<u32> {
        self.of_pixel.get(pixel).copied()
    }

    /// The pixels of a bin, in row order; none where there is no such bin.
    pub fn pixels_of(&self, bin: u32) -> &[u32] {
        let Some(bin) = self.bins.get(bin as usize) else { return &[] };
        &self.pixels[bin.first as usize..(bin.first + bin.count) as usize]
    }
}
