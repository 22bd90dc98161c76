//! JPEG files whose data end early or have a hole, though their end marker is there: never a wrong picture without a warning.

use dichroscope::photo::{ReadOptions, decode};

const BASELINE: &[u8] = include_bytes!("data/restarts.jpg");
const PROGRESSIVE: &[u8] = include_bytes!("data/progressive_restarts.jpg");
const END: [u8; 2] = [0xFF, 0xD9];

/// The warnings about the data of a JPEG, and the message of one that is refused.
fn complaint(bytes: &[u8]) -> Option<String> {
    match decode(bytes, "it.jpg", &ReadOptions::default()) {
        Ok(photo) => photo.warnings.into_iter().find(|warning| warning.starts_with("the JPEG")),
        Err(error) => Some(error.to_string()),
    }
}

/// The place behind the first scan's header.
fn first_data(bytes: &[u8]) -> usize {
    let scan = bytes.windows(2).position(|pair| pair == [0xFF, 0xDA]).unwrap() + 2;
    scan + usize::from(bytes[scan + 1])
}

/// Places of all restart markers.
fn restarts(bytes: &[u8]) -> Vec<usize> {
    let is_restart = |at: &usize| bytes[*at] == 0xFF && (0xD0..=0xD7).contains(&bytes[at + 1]);
    (first_data(bytes)..bytes.len() - 1).filter(is_restart).collect()
}

#[test]
fn intact_files_have_no_warning() {
    for bytes in [
        BASELINE,
        PROGRESSIVE,
        include_bytes!("data/luma_below_chroma.jpg"),
        include_bytes!("data/progressive.jpg"),
        include_bytes!("data/rgb_ids.jpg"),
        include_bytes!("data/scans_2x2.jpg"),
        include_bytes!("data/thirds.jpg"),
    ] {
        assert_eq!(complaint(bytes), None);
    }
    // Bytes of padding before the end marker are harmless.
    let padded = [&BASELINE[..BASELINE.len() - 2], &[0; 7], &END].concat();
    assert_eq!(complaint(&padded), None);
}

#[test]
fn data_that_end_early_are_told() {
    for bytes in [BASELINE, PROGRESSIVE] {
        for length in first_data(bytes)..bytes.len() - 3 {
            let cut = [&bytes[..length], &END].concat();
            assert!(complaint(&cut).is_some(), "cut to {length} of {}", bytes.len());
        }
    }
    let half = first_data(BASELINE).midpoint(BASELINE.len());
    let told = complaint(&[&BASELINE[..half], &END].concat()).unwrap();
    assert!(told.starts_with("the JPEG's data end early: the picture from row "), "{told}");
    let scans = PROGRESSIVE.windows(2).rposition(|pair| pair == [0xFF, 0xC4]).unwrap();
    let told = complaint(&[&PROGRESSIVE[..scans], &END].concat()).unwrap();
    assert!(told.starts_with("the JPEG lacks its last scans"), "{told}");
}

#[test]
fn holes_between_restart_markers_are_told() {
    for bytes in [BASELINE, PROGRESSIVE] {
        let restarts = restarts(bytes);
        assert!(restarts.len() > 5);
        for pair in restarts.windows(2) {
            // A whole interval is missing, and a part of one.
            for begin in [pair[0], pair[0] + (pair[1] - pair[0]) / 2] {
                let holed = [&bytes[..begin], &bytes[pair[1]..]].concat();
                // In a progressive file, intervals of the refining scans may lie between two scans, where no marker belongs.
                let told = complaint(&holed);
                assert!(told.is_some(), "a hole from {begin} to {}", pair[1]);
            }
        }
    }
    let at = restarts(BASELINE);
    let told = complaint(&[&BASELINE[..at[2]], &BASELINE[at[3]..]].concat()).unwrap();
    assert!(told.starts_with("the JPEG's data are damaged: the picture from row 16 on may be"), "{told}");
}
