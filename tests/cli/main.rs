//! The program end to end: what each command writes, what it says, and with which exit code it ends.

#![allow(clippy::unwrap_used, reason = "helpers of tests are tests too")]

mod analyze;
mod contract;
mod documents;
mod folder;
mod trace;
