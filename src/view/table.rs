//! The regions as text for other programs.

use super::ResultSnapshot;
use std::fmt::Write;

/// The table of the regions as text: one region a line, columns separated by tabs, with a line of headings.
pub fn regions_text(shown: &ResultSnapshot) -> String {
    let mut text = String::from(
        "region\tpixels\tmatte_pixels\thighlight_pixels\tclipped_pixels\tbody_r\tbody_g\tbody_b\tsurface_r\tsurface_g\tsurface_b\tangle_deg\tfit_rms_counts\tseparable\twarnings\n",
    );
    for region in &shown.analysis.intrinsic.regions {
        let [r, g, b] = region.body;
        let surface =
            region.surface.map_or_else(|| "\t\t".to_owned(), |[r, g, b]| format!("{r:.5}\t{g:.5}\t{b:.5}"));
        let angle = region.angle_deg.map_or_else(String::new, |angle| format!("{angle:.2}"));
        // Writing to a string cannot fail.
        let _ = writeln!(
            text,
            "{}\t{}\t{}\t{}\t{}\t{r:.5}\t{g:.5}\t{b:.5}\t{surface}\t{angle}\t{:.3}\t{}\t{}",
            region.id,
            region.pixels,
            region.matte_pixels,
            region.highlight_pixels,
            region.clipped_pixels,
            region.fit_rms_counts,
            region.separable,
            region.warnings.join("; ")
        );
    }
    text
}
