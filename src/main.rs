//! The `rayscope` program.

fn main() -> std::process::ExitCode {
    rayscope::cli::main()
}
