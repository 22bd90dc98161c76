//! Parameters from flags and a TOML file: defaults of the method, or a preset < file < `--auto` < single flags.

use super::note;
use anyhow::{Context, Result, anyhow, bail};
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use clap::{Arg, ArgMatches, Args, FromArgMatches};
use dichroscope::params::{
    AmbientSetting, FeatureSet, IlluminantSetting, Method, Parameter, Params, PhoenixParameter, Preset,
    Reading, Setting, Switch, toml_error, unread_tables,
};
use std::path::{Path, PathBuf};

/// How to analyze.
#[derive(Debug, Args)]
#[command(next_help_heading = "Method and parameters")]
pub(super) struct Settings {
    /// The 1990 algorithm with refinements, or as it was written, or an earlier method; by-hand needs --area
    #[arg(long, value_parser = method_parser())]
    method: Option<Method>,
    /// The paper's parameters for one of its pictures (a column of table 6), and its method unless --method says otherwise
    #[arg(long, value_name = "NAME", value_parser = preset_parser())]
    preset: Option<Preset>,
    /// Parameters from a TOML file: `method`, one key per parameter, the switches under `[refine]`, and the readings under `[paper]`
    #[arg(long, value_name = "FILE.toml")]
    params: Option<PathBuf>,
    /// Estimate from the image whatever can be, except what a flag of its own sets
    #[arg(long)]
    auto: bool,
    /// Switch a refinement on, or add it to the paper's method (repeatable)
    #[arg(long, value_name = "NAME", value_parser = switch_parser())]
    with: Vec<Switch>,
    /// Switch a refinement off (repeatable; names as for --with)
    #[arg(long, value_name = "NAME", value_parser = switch_parser(), hide_possible_values = true)]
    without: Vec<Switch>,
    /// Read the paper's text as this reading says; only with the paper's method (repeatable)
    #[arg(long, value_name = "NAME", value_parser = reading_parser())]
    reading: Vec<Reading>,
    /// Read the paper's text the other way (repeatable; names as for --reading)
    #[arg(long, value_name = "NAME", value_parser = reading_parser(), hide_possible_values = true)]
    without_reading: Vec<Reading>,
    /// Color features whose histograms Phoenix searches, separated by commas: R, G, B, I (intensity), H (hue), S (saturation), Y, P (the I
    /// of YIQ), Q [default: I,H,S]
    #[arg(long, value_name = "LETTERS")]
    features: Option<FeatureSet>,
    /// A parameter of Phoenix by its published name, as in maxmin=160 (repeatable; see docs/baselines.md)
    #[arg(long, value_name = "NAME=N", value_parser = phoenix_value)]
    phoenix: Vec<(PhoenixParameter, u32)>,
    #[command(flatten)]
    flags: ParameterFlags,
    /// The color of the light, of any length; every dichromatic plane turns to it [default: auto]
    #[arg(long, value_name = "R,G,B|auto", allow_hyphen_values = true)]
    illuminant: Option<IlluminantSetting>,
    /// The color of a second lamp, of any length; each region is split with the lamp that its highlights agree with; refined method only
    /// [default: auto]
    #[arg(long, value_name = "R,G,B|auto", allow_hyphen_values = true)]
    second_illuminant: Option<IlluminantSetting>,
    /// The ambient light, counts a band: found where the matte lines meet, given, or left alone [default: auto]
    #[arg(long, value_name = "auto|R,G,B|off", allow_hyphen_values = true)]
    ambient: Option<AmbientSetting>,
}

impl Settings {
    /// The parameters that defaults, preset, file and flags give together.
    ///
    /// Fails on an unreadable file, an unknown name, a value out of range, and switches that contradict each other.
    pub(super) fn params(&self) -> Result<Params> {
        let file = self.params.as_deref().map(read_toml).transpose()?.unwrap_or_default();
        let by_method = || Params::of(self.method.or(file.method).unwrap_or_default());
        let mut params = self.preset.map_or_else(by_method, Preset::params);
        params = overlay(&params, file.table)?;
        params.method = self.method.unwrap_or(params.method);
        for parameter in Parameter::ALL {
            let asked = self.flags.get(parameter).or(self.auto.then_some(Setting::Auto));
            if let Some(setting) = asked {
                *params.slot(parameter) = setting;
            }
        }
        params.illuminant = self.illuminant.unwrap_or(params.illuminant);
        params.second_illuminant = self.second_illuminant.unwrap_or(params.second_illuminant);
        params.ambient = self.ambient.unwrap_or(params.ambient);
        self.switch(&mut params)?;
        self.read(&mut params)?;
        self.set_phoenix(&mut params)?;
        params.validate()?;
        if let Some(path) = &self.params {
            for sentence in unread_tables(&path.display().to_string(), &file.text, params.method) {
                note(&format!("warning: {sentence}"));
            }
        }
        Ok(params)
    }

    /// Fails where the method needs an area and none is given.
    pub(super) fn expect_area(params: &Params, has_area: bool) -> Result<()> {
        if params.method == Method::ByHand && !has_area {
            bail!(
                "`--method by-hand` fits a skewed T to marked pixels: give their mask with --area MASK.png, a picture of the \
                 photograph's size that is black outside of one object"
            );
        }
        Ok(())
    }

    fn set_phoenix(&self, params: &mut Params) -> Result<()> {
        if params.method != Method::Phoenix && (self.features.is_some() || !self.phoenix.is_empty()) {
            bail!("--features and --phoenix belong to `--method phoenix`");
        }
        params.phoenix.features = self.features.unwrap_or(params.phoenix.features);
        for &(parameter, value) in &self.phoenix {
            *parameter.slot(&mut params.phoenix) = value;
        }
        Ok(())
    }

    fn switch(&self, params: &mut Params) -> Result<()> {
        if let Some(switch) = self.with.iter().find(|switch| self.without.contains(switch)) {
            bail!("{} is both --with and --without", switch.name());
        }
        let is_baseline = params.baseline().is_some();
        if is_baseline && !(self.with.is_empty() && self.without.is_empty()) {
            bail!("--with and --without belong to `--method refined` and `--method paper`");
        }
        for (switches, on) in [(&self.with, true), (&self.without, false)] {
            for &switch in switches {
                params.refinements_mut().set(switch, on);
            }
        }
        Ok(())
    }

    fn read(&self, params: &mut Params) -> Result<()> {
        if let Some(reading) = self.reading.iter().find(|reading| self.without_reading.contains(reading)) {
            bail!("{} is both --reading and --without-reading", reading.name());
        }
        let any = !(self.reading.is_empty() && self.without_reading.is_empty());
        if params.method != Method::Paper && any {
            bail!(
                "--reading and --without-reading belong to `--method paper`: the refined method reads the text in one way"
            );
        }
        for (readings, on) in [(&self.reading, true), (&self.without_reading, false)] {
            for &reading in readings {
                params.paper.readings.set(reading, on);
            }
        }
        Ok(())
    }
}

/// The content of a parameter file. Missing keys keep the value of the method or preset.
#[derive(Debug, Default)]
struct File {
    method: Option<Method>,
    table: toml::Table,
    text: String,
}

fn read_toml(path: &Path) -> Result<File> {
    let text = std::fs::read_to_string(path).with_context(|| format!("cannot read {}", path.display()))?;
    // Parsed as `Params` first, whose errors name unknown keys and their lines.
    let located = |error| anyhow!(toml_error(&path.display().to_string(), &text, &error));
    let params: Params = toml::from_str(&text).map_err(located)?;
    let table: toml::Table = toml::from_str(&text).map_err(located)?;
    params.validate().with_context(|| path.display().to_string())?;
    Ok(File { method: table.contains_key("method").then_some(params.method), table, text })
}

/// `base` with the values of `table` in place of its own.
fn overlay(base: &Params, table: toml::Table) -> Result<Params> {
    let mut all = toml::Table::try_from(base)?;
    for (key, value) in table {
        match (all.get_mut(&key), value) {
            (Some(toml::Value::Table(base)), toml::Value::Table(over)) => base.extend(over),
            (_, value) => {
                all.insert(key, value);
            }
        }
    }
    Ok(all.try_into()?)
}

fn method_parser() -> impl TypedValueParser<Value = Method> {
    let value = |method: Method| PossibleValue::new(method.name()).help(method.meaning());
    PossibleValuesParser::new(Method::ALL.map(value))
        .try_map(|name| Method::from_name(&name).ok_or("no such method"))
}

/// `maxmin=160` as a parameter of Phoenix and its value.
fn phoenix_value(text: &str) -> Result<(PhoenixParameter, u32), String> {
    let (name, value) = text.split_once('=').ok_or("expected NAME=N, as in maxmin=160")?;
    let parameter = PhoenixParameter::from_name(name).ok_or_else(|| {
        let names = PhoenixParameter::ALL.map(PhoenixParameter::name).join(", ");
        format!("{name:?} is no parameter of Phoenix: {names}")
    })?;
    Ok((parameter, value.parse().map_err(|_| format!("{value:?} is no whole number"))?))
}

fn preset_parser() -> impl TypedValueParser<Value = Preset> {
    PossibleValuesParser::new(Preset::ALL.map(Preset::name))
        .try_map(|name| Preset::from_name(&name).ok_or("no such preset"))
}

fn switch_parser() -> impl TypedValueParser<Value = Switch> {
    PossibleValuesParser::new(Switch::ALL.map(Switch::name)).try_map(|name| Switch::from_name(&name))
}

fn reading_parser() -> impl TypedValueParser<Value = Reading> {
    let value = |reading: Reading| PossibleValue::new(reading.name()).help(reading.spec().title);
    PossibleValuesParser::new(Reading::ALL.map(value)).try_map(|name| Reading::from_name(&name))
}

/// One flag per parameter, made from [`Parameter::spec`].
#[derive(Debug)]
struct ParameterFlags([Option<Setting>; Parameter::ALL.len()]);

impl ParameterFlags {
    fn get(&self, parameter: Parameter) -> Option<Setting> {
        self.0[Parameter::ALL.iter().position(|&other| other == parameter)?]
    }
}

impl Args for ParameterFlags {
    fn augment_args(command: clap::Command) -> clap::Command {
        Parameter::ALL.into_iter().fold(command, |command, parameter| {
            let spec = parameter.spec();
            let default = Params::default().get(parameter);
            let help =
                format!("{} ({}) [default: {default}; paper: {}]", spec.meaning, spec.unit, spec.paper);
            command.arg(
                Arg::new(spec.name)
                    .long(spec.name.replace('_', "-"))
                    .value_name("V|auto")
                    .value_parser(str::parse::<Setting>)
                    .allow_hyphen_values(true)
                    .help(help),
            )
        })
    }

    fn augment_args_for_update(command: clap::Command) -> clap::Command {
        Self::augment_args(command)
    }
}

impl FromArgMatches for ParameterFlags {
    fn from_arg_matches(matches: &ArgMatches) -> Result<Self, clap::Error> {
        Ok(Self(Parameter::ALL.map(|parameter| matches.get_one(parameter.spec().name).copied())))
    }

    fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> Result<(), clap::Error> {
        *self = Self::from_arg_matches(matches)?;
        Ok(())
    }
}
