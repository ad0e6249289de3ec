//! The compiler of the images and the emulator.

use std::fs;
use std::path::{Path, PathBuf};

use crate::boards::Board;
use crate::cross::Cross;
use crate::elf;
use crate::images::{self, Profile};
use crate::qemu::Qemu;
use crate::reading::Reading;
use crate::steps::Steps;

/// What firmware needs beside cargo.
#[derive(Clone, Debug)]
pub struct Tools {
    pub(crate) cross: Cross,
    pub(crate) qemu: Qemu,
}

/// Makes sure of the tools.
pub fn setup(steps: &mut Steps) -> Option<Tools> {
    let cross = steps.run("setup: std for the boards", Cross::find);
    let qemu = steps.run("setup: QEMU", Qemu::find);
    Some(Tools { cross: cross?, qemu: qemu? })
}

impl Tools {
    /// The compiler of the images.
    #[must_use]
    pub const fn cross(&self) -> &Cross {
        &self.cross
    }

    /// Builds an image for a board; its path.
    ///
    /// # Errors
    /// The compiler's.
    pub fn image(&self, board: &Board, name: &str) -> Result<PathBuf, String> {
        images::of_board(&self.cross, board, Profile::Release, name)
    }

    /// Runs an image on a board, with a file in memory. Its answers are `expected`, bit by bit: at
    /// least so many blocks of each kind.
    ///
    /// # Errors
    /// Other bits, or an image that does not end.
    pub fn asked(
        &self,
        board: &Board,
        image: &Path,
        loaded: (&Path, u32),
        expected: &Reading,
        least: u32,
    ) -> Result<Reading, String> {
        let printed = self.qemu.run(board.machine, image, Some(loaded))?;
        let reading = Reading::parse(&printed, Some(board))?;
        reading.compare(expected, least)?;
        Ok(reading)
    }

    /// Runs an image of the suite on a board, with a blob at the end of its flash.
    ///
    /// # Errors
    /// As above, or flash that is too small for both.
    pub fn asked_in_flash(
        &self,
        board: &Board,
        image: &Path,
        flash: &Path,
        expected: &Reading,
        least: u32,
    ) -> Result<Reading, String> {
        let length = fs::metadata(flash)
            .map_err(|error| format!("cannot read {}: {error}", flash.display()))?
            .len();
        let end = elf::address(image, "meshsweep_flash_end")?;
        let (begin, used) = (end.saturating_sub(length), elf::end_in_flash(image, end)?);
        if used > begin {
            return Err(format!("image and blob need {} bytes more than the flash", used - begin));
        }
        let begin = u32::try_from(begin).map_err(|error| error.to_string())?;
        self.asked(board, image, (flash, begin), expected, least)
    }
}
