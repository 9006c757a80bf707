//! The command `amas`: hands over to the library.

use std::process::ExitCode;

fn main() -> ExitCode {
    amas::app::main()
}
