//! The call of `dichroscope analyze` that repeats the analysis on the screen.

use super::State;
use super::write::AREA_FILE;
use crate::params::{
    AmbientSetting, IlluminantSetting, Method, Parameter, Params, PhoenixParameter, Reading, Switch,
};
use crate::truth::sample::CAMERA_FILE;
use crate::view::Origin;
use std::path::Path;

/// The call that analyzes the open photograph as the window does, for a POSIX shell. It contains only what differs from the
/// defaults. A comment at its end names files that must be exported first.
pub fn analyze_call(state: &State) -> String {
    let mut words = vec!["dichroscope".to_owned(), "analyze".to_owned()];
    let mut hints = Vec::new();
    match state.picture.as_ref().map(|picture| &picture.origin) {
        Some(Origin::File(path)) => words.push(quoted_path(path)),
        Some(Origin::Sample(name)) => {
            words.push(CAMERA_FILE.to_owned());
            hints.push(format!("{CAMERA_FILE}: the sample scene, assets/{name}/{CAMERA_FILE} in the source"));
        }
        Some(Origin::Bytes { name, .. }) => {
            words.push("PHOTO".to_owned());
            hints.push(format!("PHOTO: {name} came without a file, save it first"));
        }
        None => words.push("PHOTO".to_owned()),
    }
    words.extend(["--out".to_owned(), "results".to_owned()]);
    words.extend(reading_words(state));
    words.extend(params_words(&state.document.params));
    if state.document.area.is_some() {
        words.extend(["--area".to_owned(), AREA_FILE.to_owned()]);
        hints.push(format!("{AREA_FILE}: export the area under this name first"));
    }
    let call = words.join(" ");
    if hints.is_empty() { call } else { format!("{call}  # {}", hints.join("; ").replace('\n', " ")) }
}

/// How the photograph is read, and the ground truth beside it.
fn reading_words(state: &State) -> Vec<String> {
    let Some(picture) = &state.picture else { return Vec::new() };
    let mut words = Vec::new();
    let encoding = picture.reading.encoding.to_string();
    if encoding != "auto" {
        words.extend(["--encoding".to_owned(), encoding]);
    }
    if let Some(full_scale) = picture.reading.full_scale {
        words.extend(["--full-scale".to_owned(), full_scale.to_string()]);
    }
    if let (Some(_), Some(folder)) = (&picture.truth, picture.origin.path().and_then(Path::parent)) {
        let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
        words.extend(["--truth".to_owned(), quoted_path(folder)]);
    }
    words
}

/// Flags of the parameters and switches that differ from the defaults of their method.
fn params_words(params: &Params) -> Vec<String> {
    let mut words = Vec::new();
    if params.method != Method::default() {
        words.extend(["--method".to_owned(), params.method.name().to_owned()]);
    }
    let defaults = Params::of(params.method);
    for parameter in Parameter::ALL {
        if params.get(parameter) != defaults.get(parameter) {
            words.push(format!("--{}", parameter.spec().name.replace('_', "-")));
            words.push(params.get(parameter).to_string());
        }
    }
    if params.illuminant != IlluminantSetting::Auto {
        words.extend(["--illuminant".to_owned(), params.illuminant.to_string()]);
    }
    if params.second_illuminant != IlluminantSetting::Auto {
        words.extend(["--second-illuminant".to_owned(), params.second_illuminant.to_string()]);
    }
    if params.ambient != AmbientSetting::Auto {
        words.extend(["--ambient".to_owned(), params.ambient.to_string()]);
    }
    for switch in Switch::ALL {
        let on = params.refinements().get(switch);
        if on != defaults.refinements().get(switch) {
            words.push(if on { "--with" } else { "--without" }.to_owned());
            words.push(switch.name().to_owned());
        }
    }
    if params.method == Method::Phoenix {
        words.extend(phoenix_words(params, &defaults));
    }
    // The readings of the refined method are fixed.
    if params.method == Method::Paper {
        for reading in Reading::ALL {
            let on = params.paper.readings.get(reading);
            if on != defaults.paper.readings.get(reading) {
                words.push(if on { "--reading" } else { "--without-reading" }.to_owned());
                words.push(reading.name().to_owned());
            }
        }
    }
    words
}

/// Flags of the parameters of Phoenix that differ from `defaults`.
fn phoenix_words(params: &Params, defaults: &Params) -> Vec<String> {
    let mut words = Vec::new();
    let (settings, usual) = (&params.phoenix, &defaults.phoenix);
    if settings.features != usual.features {
        words.extend(["--features".to_owned(), settings.features.to_string()]);
    }
    for parameter in PhoenixParameter::ALL {
        let value = parameter.get(settings);
        if value != parameter.get(usual) {
            words.extend(["--phoenix".to_owned(), format!("{}={value}", parameter.name())]);
        }
    }
    words
}

/// A path, quoted for a POSIX shell where needed.
fn quoted_path(path: &Path) -> String {
    let text = path.display().to_string();
    // The folder before a name that begins with `-` keeps it from being read as a flag.
    quoted(&if text.starts_with('-') { format!("./{text}") } else { text })
}

/// A word, quoted for a POSIX shell where it needs that.
fn quoted(word: &str) -> String {
    let plain = |c: char| c.is_ascii_alphanumeric() || "_@%+=:,./-".contains(c);
    if !word.is_empty() && word.chars().all(plain) {
        return word.to_owned();
    }
    format!("'{}'", word.replace('\'', r"'\''"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::params::Setting;
    use crate::photo::{EncodingChoice, ReadOptions};
    use crate::view::Picture;
    use crate::view::testing::gray;
    use std::sync::Arc;

    fn open(path: &str, change: impl FnOnce(&mut Picture)) -> State {
        let mut picture = Arc::into_inner(gray(&["."], 9)).unwrap();
        (picture.origin, picture.reading) = (Origin::File(path.into()), ReadOptions::default());
        change(&mut picture);
        State { picture: Some(Arc::new(picture)), ..State::default() }
    }

    #[test]
    fn a_call_with_defaults_has_no_flags() {
        assert_eq!(analyze_call(&State::default()), "dichroscope analyze PHOTO --out results");
        assert_eq!(analyze_call(&open("a/b.png", |_| ())), "dichroscope analyze a/b.png --out results");
    }

    #[test]
    fn a_call_holds_the_parameters_that_differ_from_the_defaults() {
        let mut state = open("my photo's.png", |picture| {
            picture.reading.encoding = EncodingChoice::Gamma(2.2);
            picture.reading.full_scale = Some(2040.0);
        });
        let params = &mut state.document.params;
        params.camera_noise = Setting::Value(3.5);
        params.min_area = Setting::Auto;
        params.refine.second_look = false;
        params.illuminant = IlluminantSetting::Given([1.0, 0.5, 0.25]);
        params.second_illuminant = IlluminantSetting::Given([0.25, 0.5, 1.0]);
        params.ambient = AmbientSetting::Off;
        state.document.area = Some(Arc::new(crate::raster::Raster::filled(1, 1, true)));
        assert_eq!(
            analyze_call(&state),
            "dichroscope analyze 'my photo'\\''s.png' --out results --encoding gamma:2.2 --full-scale 2040 \
             --camera-noise 3.5 --min-area auto --illuminant 1,0.5,0.25 --second-illuminant 0.25,0.5,1 --ambient off --without second_look \
             --area area.png  \
             # area.png: export the area under this name first"
        );
    }

    #[test]
    fn the_papers_method_has_its_own_defaults_and_no_switches() {
        let mut state = open("-a.png", |_| ());
        state.document.params = Params::paper();
        state.document.params.refine.second_look = false;
        assert_eq!(analyze_call(&state), "dichroscope analyze ./-a.png --out results --method paper");
    }

    #[test]
    fn a_call_names_the_photograph_that_has_no_file() {
        let mut state = open("x", |picture| picture.origin = Origin::Sample("plastic8_white".into()));
        assert!(analyze_call(&state).contains("# camera8.png: the sample scene"));
        state = State { picture: Some(gray(&["."], 9)), ..State::default() };
        assert!(analyze_call(&state).ends_with("# PHOTO: made.ppm came without a file, save it first"));
    }
}
