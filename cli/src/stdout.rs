//! [`Stdout`]: errors of the standard output that say so.

use std::io::{self, StdoutLock, Write};

/// The standard output. What the system says of it alone, such as "No space left on device", names no file.
pub(crate) struct Stdout(StdoutLock<'static>);

impl Stdout {
    /// The standard output, for this thread alone.
    pub(crate) fn lock() -> Self {
        Self(io::stdout().lock())
    }
}

impl Write for Stdout {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.0.write(bytes).map_err(|error| named(&error))
    }

    fn flush(&mut self) -> io::Result<()> {
        self.0.flush().map_err(|error| named(&error))
    }
}

/// The same kind of error: whoever reads stdout may have hung up, and a write that was interrupted is tried again.
fn named(error: &io::Error) -> io::Error {
    io::Error::new(
        error.kind(),
        format!("cannot write to the standard output: {error}"),
    )
}
