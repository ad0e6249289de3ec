//! The functions of a linked image, their frames and their calls: from these the most stack that a
//! function can take.
//!
//! Frames are the compiler's own numbers (section `.stack_sizes`). Functions that come compiled or
//! in assembly, such as `__aeabi_fadd`, have none: their instructions are read. Calls are the
//! relocations that the linker leaves in the image. A bound exists if no function is reached from
//! itself, and if none is called through a pointer: both are refused.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use object::elf::{self, RelocationType};
use object::read::elf::ElfFile32;
use object::{
    Endianness, Object, ObjectSection, ObjectSymbol, RelocationFlags, RelocationTarget,
    SectionFlags, SymbolKind,
};

use crate::elf::with;
use crate::instructions::{Does, Set, read};

/// A function.
#[derive(Clone, Debug, Default)]
struct Function {
    name: String,
    bytes: u64,
    /// Bytes of stack between the caller and what it calls.
    frame: u32,
    /// Called functions, by address; `true` if the own frame is gone by then.
    calls: Vec<(u64, bool)>,
    /// Why no bound can be told.
    refused: Option<String>,
}

/// All functions of an image.
#[derive(Clone, Debug, Default)]
pub struct CallGraph {
    functions: BTreeMap<u64, Function>,
    /// Whether the address of a function is taken. If none is, a jump to an address in a register
    /// is one into a table of a `match`, for there is nothing else that it could be.
    pub takes_addresses: bool,
}

/// A bound, and the calls that reach it.
#[derive(Clone, Debug, Default)]
pub struct Bound {
    /// Bytes below the caller.
    pub bytes: u32,
    /// Frame and name of each function of the deepest calls.
    pub way: Vec<(u32, String)>,
}

impl Bound {
    /// The way, a line a function.
    pub fn text(&self) -> String {
        let lines = self.way.iter().map(|(frame, name)| format!("{frame:>8} {name}\n"));
        lines.collect()
    }
}

impl CallGraph {
    /// Reads an image.
    ///
    /// # Errors
    /// No stack sizes or no relocations: the image was built without.
    pub fn of(image: &Path) -> Result<Self, String> {
        with(image, |file| graph(file).map_err(|reason| format!("{}: {reason}", image.display())))?
    }

    /// The most stack that a function takes, by its name without the arguments of generics. Of
    /// several instances the largest.
    ///
    /// # Errors
    /// There is none, or it can reach itself, or a call through a pointer.
    pub fn bound(&self, name: &str) -> Result<Bound, String> {
        let is_it = |function: &&u64| plain(&self.functions[function].name) == name;
        let mut known = BTreeMap::new();
        let bounds = self.functions.keys().filter(is_it).map(|at| self.below(*at, &mut known));
        let bounds = bounds.collect::<Result<Vec<_>, _>>()?;
        let most = bounds.into_iter().max_by_key(|bound| bound.bytes);
        most.ok_or_else(|| format!("no function `{name}` in the image"))
    }

    /// The frame of the instance of a function whose name has this word.
    pub fn frame(&self, name: &str, word: &str) -> Option<u32> {
        let mut all = self.functions.values();
        let is_it =
            |function: &&Function| plain(&function.name) == name && function.name.contains(word);
        all.find(is_it).map(|function| function.frame)
    }

    fn below(&self, at: u64, known: &mut BTreeMap<u64, Option<Bound>>) -> Result<Bound, String> {
        let function =
            self.functions.get(&at).ok_or_else(|| format!("a call of {at:#x}, unknown"))?;
        match known.get(&at) {
            Some(Some(bound)) => return Ok(bound.clone()),
            Some(None) => return Err(format!("`{}` is reached from itself", function.name)),
            None => {}
        }
        if let Some(reason) = &function.refused {
            return Err(format!("`{}` {reason}", function.name));
        }
        known.insert(at, None);
        let mut deepest = Bound::default();
        for &(callee, is_last) in &function.calls {
            let mut below = self.below(callee, known)?;
            if !is_last {
                below.bytes += function.frame;
                below.way.insert(0, (function.frame, function.name.clone()));
            }
            if below.bytes > deepest.bytes {
                deepest = below;
            }
        }
        if deepest.bytes < function.frame {
            let way = vec![(function.frame, function.name.clone())];
            deepest = Bound { bytes: function.frame, way };
        }
        known.insert(at, Some(deepest.clone()));
        Ok(deepest)
    }
}

/// A name without the arguments of generics.
fn plain(name: &str) -> &str {
    name.split_once("::<").map_or(name, |(plain, _)| plain)
}

type File<'a> = ElfFile32<'a, Endianness>;

fn graph(file: &File<'_>) -> Result<CallGraph, String> {
    let is_arm = file.architecture() == object::Architecture::Arm;
    let set = if is_arm { Set::Thumb } else { Set::RiscV };
    let mut functions = functions(file, set);
    let sizes = stack_sizes(file)?;
    let references = References::read(file, set, &mut functions)?;
    let data = pieces_of_data(file);
    for (&at, function) in &mut functions {
        let mut frame = Some(0);
        for (offset, does) in read(set, bytes(file, at, function.bytes)) {
            let place = at + offset as u64;
            if data.range(..=place).next_back().is_some_and(|(_, is_data)| *is_data) {
                continue;
            }
            let is_known = references.calls.contains(&place);
            match does {
                Does::Lowers(bytes) => frame = frame.map(|all: u32| all + bytes),
                Does::SetsStack => frame = None,
                // Without BL an ARMv6-M goes no farther than 2 KB.
                Does::Calls(Some(way))
                    if (at..at + function.bytes)
                        .contains(&place.wrapping_add_signed(way.into())) => {}
                Does::Calls(_) | Does::CallsRegister if !is_known => {
                    function.refused = Some(format!("calls a computed address at {place:#x}"));
                }
                _ => {}
            }
        }
        match sizes.get(&at).copied().or(frame) {
            Some(frame) => function.frame = frame,
            None => function.refused = Some("has a frame that its code does not tell".to_owned()),
        }
    }
    Ok(CallGraph { functions, takes_addresses: references.takes_addresses })
}

/// Functions by address, without frames and calls.
fn functions(file: &File<'_>, set: Set) -> BTreeMap<u64, Function> {
    let mut functions = BTreeMap::new();
    for symbol in file.symbols() {
        if symbol.kind() == SymbolKind::Text && symbol.is_definition() {
            let name = symbol.name().unwrap_or_default();
            let name = format!("{:#}", rustc_demangle::demangle(name));
            let function = Function { name, bytes: symbol.size(), ..Function::default() };
            functions.entry(even(set, symbol.address())).or_insert(function);
        }
    }
    functions
}

/// The address of a function, without the bit that says Thumb.
fn even(set: Set, address: u64) -> u64 {
    if set == Set::Thumb { address & !1 } else { address }
}

/// What the compiler says of frames: pairs of an address and a number of seven bits a byte.
fn stack_sizes(file: &File<'_>) -> Result<BTreeMap<u64, u32>, String> {
    let section = file.section_by_name(".stack_sizes").ok_or("an image without stack sizes")?;
    let mut rest = section.data().map_err(|error| error.to_string())?;
    let mut sizes = BTreeMap::new();
    while let Some((address, after)) = rest.split_first_chunk() {
        let length = after.iter().take_while(|byte| **byte >= 0x80).count() + 1;
        let number = after.get(..length).ok_or("stack sizes that end early")?;
        let digits = number.iter().rev();
        let size = digits.fold(0, |size, byte| size << 7 | u32::from(byte & 0x7F));
        sizes.insert(u64::from(u32::from_le_bytes(*address) & !1), size);
        rest = &after[length..];
    }
    Ok(sizes)
}

/// Where data begins within code, and where code begins again.
fn pieces_of_data(file: &File<'_>) -> BTreeMap<u64, bool> {
    let marks = file.symbols().filter_map(|symbol| {
        let name = symbol.name().ok()?.as_bytes();
        (name.first() == Some(&b'$')).then(|| (symbol.address(), name.get(1) == Some(&b'd')))
    });
    marks.collect()
}

fn bytes<'a>(file: &File<'a>, at: u64, count: u64) -> &'a [u8] {
    let mut found = file.sections().filter_map(|section| section.data_range(at, count).ok()?);
    found.next().unwrap_or_default()
}

/// What the linker left of its work.
#[derive(Default)]
struct References {
    /// Addresses of instructions that call or jump to a function.
    calls: BTreeSet<u64>,
    /// Whether the address of a function is taken, so that there may be a pointer to it.
    takes_addresses: bool,
}

impl References {
    /// Reads them, and gives each function its calls.
    fn read(
        file: &File<'_>,
        set: Set,
        functions: &mut BTreeMap<u64, Function>,
    ) -> Result<Self, String> {
        let mut all = Self::default();
        let loaded = |flags: SectionFlags| {
            matches!(flags, SectionFlags::Elf { sh_flags, .. }
                if sh_flags.0 & elf::SHF_ALLOC.0 != 0)
        };
        let mut any = false;
        for section in file.sections().filter(|section| loaded(section.flags())) {
            for (at, relocation) in section.relocations() {
                any = true;
                let RelocationTarget::Symbol(index) = relocation.target() else { continue };
                let RelocationFlags::Elf { r_type, .. } = relocation.flags() else { continue };
                let symbol = file.symbol_by_index(index).map_err(|error| error.to_string())?;
                let code = bytes(file, at, 8);
                let to = match code.first_chunk() {
                    // The linker has written the sum.
                    Some(word) if r_type == elf::R_ARM_ABS32 && set == Set::Thumb => {
                        u64::from(u32::from_le_bytes(*word))
                    }
                    _ if set == Set::Thumb => symbol.address(),
                    _ => symbol.address().wrapping_add_signed(relocation.addend()),
                };
                let to = even(set, to);
                let reference = Reference::of(set, r_type, code);
                if matches!(reference, Reference::Address | Reference::Nothing) {
                    let target = functions.range(..=to).next_back();
                    if let (Some((&begin, _)), Reference::Address) = (target, reference) {
                        all.takes_addresses |= begin == to && symbol.kind() != SymbolKind::Label;
                    }
                    continue;
                }
                // Start-up code in assembly may lie before all functions.
                let caller = functions.range_mut(..=at).next_back();
                let Some((&caller, function)) = caller else { continue };
                let is_within = (caller..caller + function.bytes).contains(&to);
                if reference == Reference::Call || !is_within {
                    all.calls.insert(at + behind(set, code));
                    // What the handler of a panic takes is the firmware's.
                    let name = symbol.name().unwrap_or_default();
                    if !name.ends_with("rust_begin_unwind") {
                        function.calls.push((to, reference == Reference::Jump));
                    }
                }
            }
        }
        if any { Ok(all) } else { Err("an image without relocations".to_owned()) }
    }
}

/// Bytes from a relocation of a call to the instruction that calls. AUIPC is the first of a pair.
fn behind(set: Set, code: &[u8]) -> u64 {
    let is_pair = set == Set::RiscV && code.first().is_some_and(|byte| byte & 0x7F == 0x17);
    if is_pair { 4 } else { 0 }
}

/// What a relocation is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Reference {
    /// A call that returns behind itself.
    Call,
    /// A jump: within a function, or to another one when the frame is gone.
    Jump,
    /// The address as a number.
    Address,
    /// Second parts of others, and hints for the linker.
    Nothing,
}

impl Reference {
    /// By its type and the instructions there.
    fn of(set: Set, kind: RelocationType, code: &[u8]) -> Self {
        let word = |at: usize| code.get(at..at + 4)?.try_into().ok().map(u32::from_le_bytes);
        // The register for the address behind the instruction; none for a jump.
        let links = |at: usize| {
            word(at)
                .is_some_and(|word| word >> 7 & 31 != 0 && word & 3 == 3 || word & 0xE003 == 0x2001)
        };
        let of = |is_call: bool| if is_call { Self::Call } else { Self::Jump };
        match (set, kind) {
            (Set::Thumb, elf::R_ARM_THM_PC22) => Self::Call,
            (
                Set::Thumb,
                elf::R_ARM_THM_JUMP24
                | elf::R_ARM_THM_JUMP19
                | elf::R_ARM_THM_PC11
                | elf::R_ARM_THM_PC9,
            ) => Self::Jump,
            (Set::RiscV, elf::R_RISCV_CALL | elf::R_RISCV_CALL_PLT) => of(links(4)),
            (Set::RiscV, elf::R_RISCV_JAL | elf::R_RISCV_RVC_JUMP) => of(links(0)),
            (Set::RiscV, elf::R_RISCV_BRANCH | elf::R_RISCV_RVC_BRANCH) => Self::Jump,
            (
                Set::RiscV,
                elf::R_RISCV_NONE
                | elf::R_RISCV_RELAX
                | elf::R_RISCV_ALIGN
                | elf::R_RISCV_PCREL_LO12_I
                | elf::R_RISCV_PCREL_LO12_S,
            ) => Self::Nothing,
            _ => Self::Address,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_call_is_known_at_the_instruction_that_calls() {
        let auipc_to_ra = [0x97, 0x00, 0x00, 0x00];
        let jal = [0xEF, 0x00, 0x00, 0x00];
        let bl = [0xFF, 0xF7, 0xFE, 0xFF];
        assert_eq!([behind(Set::RiscV, &auipc_to_ra), behind(Set::RiscV, &jal)], [4, 0]);
        // What follows a BL may be a call through a pointer.
        assert_eq!([behind(Set::Thumb, &bl), behind(Set::Thumb, &auipc_to_ra)], [0, 0]);
    }
}
