//! The contents of firmware images, read from their files without running them.

use std::fs;
use std::path::Path;

use object::elf::FileHeader32;
use object::read::elf::{ElfFile32, ProgramHeader};
use object::{Endianness, Object, ObjectSection, ObjectSymbol, SectionFlags, elf};

/// Bytes by kind of section.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Size {
    /// Code.
    pub text: u64,
    /// Constants.
    pub rodata: u64,
    /// RAM that is initialised from flash.
    pub data: u64,
    /// RAM that starts as zero.
    pub bss: u64,
}

impl Size {
    /// What this image has more than `base`.
    pub const fn beyond(self, base: Self) -> Self {
        Self {
            text: self.text.saturating_sub(base.text),
            rodata: self.rodata.saturating_sub(base.rodata),
            data: self.data.saturating_sub(base.data),
            bss: self.bss.saturating_sub(base.bss),
        }
    }

    /// Static RAM.
    pub const fn ram(self) -> u64 {
        self.data + self.bss
    }
}

/// Sizes of what an image puts into flash and RAM.
pub fn size(image: &Path) -> Result<Size, String> {
    with(image, |file| {
        let mut size = Size::default();
        for section in file.sections() {
            let SectionFlags::Elf { sh_flags, sh_type } = section.flags() else { continue };
            let has = |flag: elf::SectionFlags| sh_flags.0 & flag.0 != 0;
            // By flags, not by name: runtimes name their sections as they like.
            let kind = match (has(elf::SHF_ALLOC), has(elf::SHF_EXECINSTR), has(elf::SHF_WRITE)) {
                (false, ..) => continue,
                (true, true, _) => &mut size.text,
                (true, false, false) => &mut size.rodata,
                (true, false, true) if sh_type == elf::SHT_NOBITS => &mut size.bss,
                (true, false, true) => &mut size.data,
            };
            *kind += section.size();
        }
        size
    })
}

/// Whether an image defines a function of this name.
pub fn defines(image: &Path, function: &str) -> Result<bool, String> {
    with(image, |file| {
        file.symbols().any(|symbol| symbol.is_definition() && symbol.name() == Ok(function))
    })
}

/// The address of a symbol that an image or its linker script defines.
pub fn address(image: &Path, symbol: &str) -> Result<u64, String> {
    let found = with(image, |file| {
        let mut symbols = file.symbols().filter(|found| !found.is_undefined());
        symbols.find(|found| found.name() == Ok(symbol)).map(|found| found.address())
    })?;
    found.ok_or_else(|| format!("{} does not define `{symbol}`", image.display()))
}

/// The address behind all that an image puts into flash, which ends at an address.
pub fn end_in_flash(image: &Path, flash_end: u64) -> Result<u64, String> {
    with(image, |file| {
        let endian = file.endian();
        // Where it is loaded, not where it runs: flash holds the first values of RAM too.
        let loaded = file.elf_program_headers().iter().filter_map(|header| {
            let at = u64::from(header.p_paddr(endian));
            let bytes = u64::from(header.p_filesz(endian));
            let is_in_flash = header.p_type(endian) == elf::PT_LOAD && bytes > 0 && at < flash_end;
            is_in_flash.then_some(at + bytes)
        });
        loaded.max().unwrap_or(0)
    })
}

/// The source places of an image's panics: every `core::panic::Location` in its constants, as
/// `file:line:column`.
pub fn panic_places(image: &Path) -> Result<Vec<String>, String> {
    with(image, |file| {
        let sections = file.sections().filter(|section| !is_code(section.flags()));
        let constants: Vec<(u64, &[u8])> = sections
            .filter_map(|section| Some((section.address(), section.data().ok()?)))
            .filter(|(address, _)| *address != 0)
            .collect();
        let mut places: Vec<String> = constants
            .iter()
            .flat_map(|(_, bytes)| {
                bytes.chunks_exact(4).enumerate().map(move |(i, _)| &bytes[4 * i..])
            })
            .filter_map(|bytes| location(bytes, &constants))
            .collect();
        places.sort();
        places.dedup();
        places
    })
}

/// A location is the file name's address and length, the line and the column.
fn location(bytes: &[u8], constants: &[(u64, &[u8])]) -> Option<String> {
    let mut words =
        bytes.chunks_exact(4).map(|word| u32::from_le_bytes([word[0], word[1], word[2], word[3]]));
    let (address, length, line, column) =
        (words.next()?, words.next()?, words.next()?, words.next()?);
    let length = usize::try_from(length).ok().filter(|length| (4..400).contains(length))?;
    let name = constants.iter().find_map(|(base, content)| {
        let offset = usize::try_from(u64::from(address).checked_sub(*base)?).ok()?;
        content.get(offset..)?.get(..length)
    })?;
    let name = std::str::from_utf8(name).ok()?.trim_end_matches('\0');
    (name.ends_with(".rs") && line > 0 && column > 0).then(|| format!("{name}:{line}:{column}"))
}

fn is_code(flags: SectionFlags) -> bool {
    matches!(flags, SectionFlags::Elf { sh_flags, .. } if sh_flags.0 & elf::SHF_EXECINSTR.0 != 0)
}

/// Reads an image.
pub(crate) fn with<T>(
    image: &Path,
    read: impl FnOnce(&ElfFile32<'_, Endianness>) -> T,
) -> Result<T, String> {
    let bytes =
        fs::read(image).map_err(|error| format!("cannot read {}: {error}", image.display()))?;
    object::read::elf::ElfFile::<FileHeader32<Endianness>>::parse(bytes.as_slice())
        .map(|file| read(&file))
        .map_err(|error| format!("{}: {error}", image.display()))
}
