//! The command line of the bench; see the crate's README.

use std::io::{stderr, stdout};
use std::process::ExitCode;

use experiments::{cli, registry};

fn main() -> ExitCode {
    let root = cli::workspace();
    ExitCode::from(cli::main(registry::EXPERIMENTS, &root, std::env::args_os(), &mut stdout(), &mut stderr()))
}
