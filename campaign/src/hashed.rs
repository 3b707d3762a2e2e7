//! [`Hashed`]: a file that is hashed while it is read, so that it need not fit into the memory.

use std::fs::File;
use std::io::{self, BufReader, Read};
use std::path::Path;

use anyhow::Context;
use sha2::{Digest, Sha256};
use ulna_files::refuse_special;

/// What is read of it has been hashed.
pub(crate) struct Hashed {
    file: BufReader<File>,
    hash: Sha256,
}

impl Hashed {
    pub(crate) fn open(path: &Path) -> anyhow::Result<Self> {
        refuse_special(path)?;
        let file = File::open(path).with_context(|| format!("cannot read {}", path.display()))?;
        Ok(Self {
            file: BufReader::with_capacity(1 << 20, file),
            hash: Sha256::new(),
        })
    }

    /// Of all that has been read.
    pub(crate) fn hash(self) -> Sha256 {
        self.hash
    }
}

impl Read for Hashed {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let count = self.file.read(buffer)?;
        self.hash.update(buffer.get(..count).unwrap_or_default());
        Ok(count)
    }
}
