//! Hostile files: any bytes, and any fields of a TIFF, give a picture or an error of one line, never a panic or endless work.

use crate::broken::{error_of, intact};
use crate::tiffs::{self, Page};
use dichroscope::analysis::Session;
use dichroscope::app::{Application, Executor, ExportKind, JobCommand, Workspace};
use dichroscope::describe::{ImageFacts, Report};
use dichroscope::params::Params;
use dichroscope::photo::{ReadOptions, decode};
use dichroscope::view::Origin;
use proptest::collection::vec;
use proptest::prelude::*;
use proptest::sample::select;
use std::sync::{Arc, OnceLock};

/// What files of the formats begin with.
const MAGICS: [&[u8]; 12] = [
    b"",
    b"\x89PNG\r\n\x1a\n\0\0\0\x0DIHDR",
    b"\xff\xd8\xff\xc0\0\x11\x08\0\x10\0\x10\x03\x01\x22\0\x02\x11\0\x03\x11\0",
    b"II*\0\x08\0\0\0\x0C\0",
    b"MM\0*\0\0\0\x08\0\x0C",
    b"II+\0\x08\0\0\0\x10\0\0\0\0\0\0\0\x0C\0\0\0\0\0\0\0",
    b"BM\0\0\0\0\0\0\0\0\x36\0\0\0\x28\0\0\0\x08\0\0\0\x08\0\0\0\x01\0",
    b"P6 8 8 255 ",
    b"P7\nWIDTH 4\nHEIGHT 4\nDEPTH 3\nMAXVAL 255\n",
    b"RIFF\x80\0\0\0WEBPVP8L",
    b"v/1\x01\x02\0\0\0channels\0chlist\0",
    b"#?RADIANCE\n\n-Y 4 +X 4\n",
];

/// Tags whose values decide how a TIFF is read.
const TAGS: [u16; 22] = [
    254, 256, 257, 258, 259, 262, 266, 273, 274, 277, 278, 279, 281, 284, 301, 317, 320, 322, 323, 330, 338,
    339,
];

/// Values that fields take in files, and some that none takes.
fn value() -> impl Strategy<Value = u16> {
    prop_oneof![
        select(vec![0, 1, 2, 3, 4, 5, 6, 7, 8, 12, 16, 24, 32, 64, 32773, 32946, 50000, 65535]),
        any::<u16>(),
    ]
}

/// More cases where a whole night is free.
fn cases(few: u32) -> ProptestConfig {
    let factor = if std::env::var_os("DICHROSCOPE_LONG_TESTS").is_some() { 100 } else { 1 };
    ProptestConfig { cases: few * factor, failure_persistence: None, ..ProptestConfig::default() }
}

proptest! {
    #![proptest_config(cases(1000))]

    #[test]
    fn any_bytes_behind_any_magic(magic in select(MAGICS.to_vec()), bytes in vec(any::<u8>(), 0..300)) {
        error_of(&[magic, &bytes].concat(), "x");
    }

    #[test]
    fn any_change_of_an_intact_file(
        which in 0..12usize,
        changes in vec((any::<prop::sample::Index>(), any::<u8>()), 1..6),
        cut in prop::option::of(any::<prop::sample::Index>()),
    ) {
        let files = intact();
        let (name, mut bytes) = files[which % files.len()].clone();
        for (at, value) in changes {
            let at = at.index(bytes.len());
            bytes[at] = value;
        }
        if let Some(cut) = cut {
            bytes.truncate(cut.index(bytes.len()));
        }
        error_of(&bytes, name);
    }

    #[test]
    fn any_fields_of_a_tiff(
        bits in value(),
        photometric in value(),
        bands in 1..6usize,
        fields in vec((select(TAGS.to_vec()), vec(value(), 1..5)), 0..6),
        tile in prop::option::of((1..40u32, 1..40u32)),
        strip_rows in 0..5u32,
        data in vec(any::<u8>(), 0..400),
        big_endian in any::<bool>(),
    ) {
        let page = Page {
            bits: vec![bits; bands],
            photometric,
            shorts: fields,
            tile,
            strip_rows,
            chunks: data.chunks(67).map(<[u8]>::to_vec).collect(),
            ..Page::new((17, 13), 8, 1, &[])
        };
        error_of(&tiffs::file(&[page.clone(), page], big_endian), "x.tif");
    }
}

/// A file with some bytes replaced.
fn changed(bytes: &[u8], changes: &[(prop::sample::Index, u8)]) -> Vec<u8> {
    let mut bytes = bytes.to_vec();
    for (at, value) in changes {
        // Half of the changes are in the header.
        let reach = if value % 2 == 0 { bytes.len().min(400) } else { bytes.len() };
        bytes[at.index(reach)] = *value;
    }
    bytes
}

const TRUTH: [&str; 4] = ["body.exr", "surface.exr", "labels.png", "truth.json"];
const PARAMETERS: &str = "method = \"refined\"\ncamera_noise = 2.5\nwindow_size = \"auto\"\nilluminant = [1, 2, 3]\n\
    ambient = \"off\"\n[refine]\nsecond_look = false\n";

proptest! {
    #![proptest_config(cases(100))]

    #[test]
    fn any_change_of_a_truth_folder(
        which in 0..4usize,
        changes in vec((any::<prop::sample::Index>(), any::<u8>()), 1..5),
    ) {
        let tiny = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/tiny");
        let folder = tempfile::tempdir().unwrap();
        for (index, name) in TRUTH.into_iter().enumerate() {
            let bytes = std::fs::read(tiny.join(name)).unwrap();
            let bytes = if index == which { changed(&bytes, &changes) } else { bytes };
            std::fs::write(folder.path().join(name), bytes).unwrap();
        }
        let _ = dichroscope::truth::GroundTruth::read(folder.path());
    }
}

/// The workspace of a sample scene.
fn intact_workspace() -> &'static str {
    static TEXT: OnceLock<String> = OnceLock::new();
    TEXT.get_or_init(|| {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.dichroscope");
        let mut application = Application::new(Executor::Inline, || ()).unwrap();
        application.apply(JobCommand::Open(Origin::Sample("cups3_yellow".to_owned())));
        application.apply(JobCommand::Export(ExportKind::Workspace.to(path.clone())));
        assert!(Workspace::load(&path).is_ok());
        std::fs::read_to_string(path).unwrap()
    })
}

/// The report of a small picture.
fn intact_report() -> &'static str {
    static TEXT: OnceLock<String> = OnceLock::new();
    TEXT.get_or_init(|| {
        let tiny = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/tiny/camera8.png");
        let photo = dichroscope::photo::read(&tiny, &ReadOptions::default()).unwrap();
        let params = Params::default();
        let analysis = Session::new(Arc::clone(&photo.image)).run(&params, &mut ()).unwrap();
        let report = Report::new(ImageFacts::of(&photo, &"0".repeat(64)), &params, &analysis, &[]);
        report.to_json().unwrap()
    })
}

proptest! {
    #![proptest_config(cases(1000))]

    #[test]
    fn any_change_of_parameters(changes in vec((any::<prop::sample::Index>(), any::<u8>()), 1..8)) {
        let text = String::from_utf8_lossy(&changed(PARAMETERS.as_bytes(), &changes)).into_owned();
        if let Ok(params) = toml::from_str::<Params>(&text) {
            let _ = params.validate();
        }
    }

    #[test]
    fn any_change_of_a_workspace_or_report(
        changes in vec((any::<prop::sample::Index>(), any::<u8>()), 0..8),
        report in any::<bool>(),
    ) {
        let text = if report { intact_report() } else { intact_workspace() };
        let bytes = changed(text.as_bytes(), &changes);
        if report {
            let _ = Report::from_json(&bytes);
        } else {
            let folder = tempfile::tempdir().unwrap();
            let path = folder.path().join("a.dichroscope");
            std::fs::write(&path, bytes).unwrap();
            let _ = Workspace::load(&path);
        }
    }
}

/// Whatever size a short header declares, little memory is taken for it: the declared size is refused before.
#[test]
fn sizes_that_short_files_declare_are_not_believed() {
    let declared = |bytes: Vec<u8>| {
        let error = decode(&bytes, "x", &ReadOptions { max_megapixels: 1e6, ..ReadOptions::default() });
        error.err().map(|error| error.to_string()).unwrap_or_default()
    };
    for bytes in [
        b"P5\n30000 30000\n255\n".to_vec(),
        b"P1\n30000 30000\n1".to_vec(),
        b"#?RADIANCE\n\n-Y 30000 +X 30000\n".to_vec(),
        tiffs::file(&[Page { size: (30_000, 30_000), ..Page::new((1, 1), 8, 1, &[0; 64]) }], false),
        tiffs::file(
            &[Page { tile: Some((1 << 23, 1 << 23)), ..Page::new((30, 30), 16, 2, &[0; 64]) }],
            false,
        ),
        // A frame header of 65500 × 65500, and an end.
        b"\xff\xd8\xff\xc0\0\x0b\x08\xff\xdc\xff\xdc\x01\x01\x11\0\xff\xd9".to_vec(),
    ] {
        let message = declared(bytes);
        assert!(message.contains("damaged"), "{message:?}");
    }
}
