//! What other threads of this process wake the loop with: a pipe beside the terminal.

use std::io::{self, PipeReader, Read as _, Write as _, pipe};
use std::os::fd::{AsFd, BorrowedFd};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use crate::explorer::Waker;

/// The pipe: a byte in it means that somebody woke the loop.
#[derive(Debug)]
pub struct Alarm {
    reader: PipeReader,
    /// Whether that byte is there. There is never a second one, so that nobody waits for room.
    rung: Arc<AtomicBool>,
    waker: Waker,
}

impl Alarm {
    /// An alarm that nobody has rung.
    pub fn new() -> io::Result<Self> {
        let (reader, writer) = pipe()?;
        let rung = Arc::new(AtomicBool::new(false));
        let already = Arc::clone(&rung);
        let waker = Waker::new(move || {
            if !already.swap(true, Ordering::AcqRel) {
                // The loop is gone: then nobody is to be woken.
                let _ = (&writer).write_all(&[0]);
            }
        });
        Ok(Self {
            reader,
            rung,
            waker,
        })
    }

    /// What rings it.
    pub fn waker(&self) -> Waker {
        self.waker.clone()
    }

    /// Takes the byte out, which must be there.
    pub fn quiet(&mut self) -> io::Result<()> {
        self.reader.read_exact(&mut [0])?;
        self.rung.store(false, Ordering::Release);
        Ok(())
    }
}

impl AsFd for Alarm {
    /// Readable once it is rung.
    fn as_fd(&self) -> BorrowedFd<'_> {
        self.reader.as_fd()
    }
}
