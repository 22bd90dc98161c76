//! Tests of the program as a whole: the files, output and exit code of each command.

#![allow(clippy::unwrap_used, reason = "helpers of tests are tests too")]

mod analyze;
mod baselines;
mod batch;
mod contract;
mod documents;
mod figures;
mod folder;
mod parameters;
mod trace;
