//! What machine code does to the stack pointer, and where it goes to a computed address.
//!
//! Only what a bound of the stack asks: of the two instruction sets that the boards have, the
//! encodings that lower the stack pointer, and calls and jumps through a register. Sources: Arm
//! v7-M and v8-M Architecture Reference Manuals, A7.7 and C2.4; The RISC-V Instruction Set Manual,
//! volume I, chapters 24 and 26.

/// An instruction set.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Set {
    /// Thumb and Thumb-2.
    Thumb,
    /// RV32 with compressed instructions.
    RiscV,
}

/// What an instruction does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Does {
    /// Lowers the stack pointer by so many bytes.
    Lowers(u32),
    /// Sets the stack pointer to something that the instruction alone does not tell.
    SetsStack,
    /// Calls an address that it contains: so many bytes from its own, if it is Thumb.
    Calls(Option<i32>),
    /// Calls an address in a register.
    CallsRegister,
    /// Jumps to an address in a register that is not that of a return.
    JumpsToRegister,
    /// None of these.
    Else,
}

/// Each instruction of a piece of code: its offset, and what it does. Bytes behind the last whole
/// instruction are left out.
pub fn read(set: Set, code: &[u8]) -> Vec<(usize, Does)> {
    let half = |at: usize| Some(u16::from_le_bytes([*code.get(at)?, *code.get(at + 1)?]));
    let mut found = Vec::new();
    let mut at = 0;
    while let Some(first) = half(at) {
        let is_long = match set {
            Set::Thumb => first >> 11 >= 0b11101,
            Set::RiscV => first & 3 == 3,
        };
        let does = match (set, is_long.then(|| half(at + 2))) {
            (_, Some(None)) => break,
            (Set::Thumb, None) => thumb(first),
            (Set::Thumb, Some(Some(second))) => thumb_long(first, second),
            (Set::RiscV, None) => riscv(first),
            (Set::RiscV, Some(Some(second))) => {
                riscv_long(u32::from(first) | u32::from(second) << 16)
            }
        };
        found.push((at, does));
        at += if is_long { 4 } else { 2 };
    }
    found
}

fn thumb(word: u16) -> Does {
    const SP: u16 = 13;
    const LR: u16 = 14;
    const PC: u16 = 15;
    // Of instructions on high registers: the one that is written, and the one that is read.
    let (to, from) = ((word >> 4 & 8) | (word & 7), word >> 3 & 15);
    match word {
        _ if word & 0xFE00 == 0xB400 => Does::Lowers(4 * (word & 0x1FF).count_ones()),
        _ if word & 0xFF80 == 0xB080 => Does::Lowers(4 * u32::from(word & 0x7F)),
        _ if word & 0xFF87 == 0x4780 => Does::CallsRegister,
        _ if word & 0xFF87 == 0x4700 && from != LR => Does::JumpsToRegister,
        // ADD and MOV.
        _ if matches!(word >> 8, 0x44 | 0x46) && to == SP => Does::SetsStack,
        _ if matches!(word >> 8, 0x44 | 0x46) && to == PC && from != LR => Does::JumpsToRegister,
        _ => Does::Else,
    }
}

fn thumb_long(first: u16, second: u16) -> Does {
    let byte = u32::from(second & 0xFF);
    let to_sp = second >> 8 & 15 == 13;
    let high_bits = u32::from(first >> 10 & 1) << 11 | u32::from(second >> 12 & 7) << 8;
    match first {
        // PUSH.W, and STR and STRD that write their address back to the stack pointer.
        0xE92D => Does::Lowers(4 * second.count_ones()),
        0xF84D if second & 0x0F00 == 0x0D00 => Does::Lowers(byte),
        0xE96D => Does::Lowers(4 * byte),
        // VPUSH.
        0xED2D | 0xED6D => Does::Lowers(4 * byte),
        // SUB.W and SUBW of a constant. A modified constant below 256 is the constant.
        0xF1AD if to_sp && high_bits == 0 => Does::Lowers(byte),
        0xF2AD | 0xF6AD if to_sp => Does::Lowers(high_bits | byte),
        0xF1AD | 0xF5AD | 0xEBAD | 0xEA4F if to_sp => Does::SetsStack,
        _ if first >> 11 == 0b11110 && second & 0xD000 == 0xD000 => {
            Does::Calls(Some(way(first, second)))
        }
        // LDR of a computed address into the program counter; a load from the stack is a return.
        _ if first & 0xFFF0 == 0xF850 && second >> 12 == 15 && first & 15 != 13 => {
            Does::JumpsToRegister
        }
        _ => Does::Else,
    }
}

/// How far BL goes.
fn way(first: u16, second: u16) -> i32 {
    let (first, second) = (u32::from(first), u32::from(second));
    let sign = first >> 10 & 1;
    let bit = |from: u32| !(second >> from ^ sign) & 1;
    let bits = bit(13) << 23 | bit(11) << 22 | (first & 0x3FF) << 12 | (second & 0x7FF) << 1;
    // From four bytes behind its beginning.
    bits.cast_signed() - (sign << 24).cast_signed() + 4
}

fn riscv(word: u16) -> Does {
    let register = word >> 7 & 31;
    let bit = |from: u16, to: u32| u32::from(word >> from & 1) << to;
    match word {
        // C.ADDI16SP.
        _ if word & 0xEF83 == 0x6101 => {
            lowers(bit(12, 9) | bit(6, 4) | bit(5, 6) | bit(4, 8) | bit(3, 7) | bit(2, 5), 10)
        }
        // C.ADDI of the stack pointer.
        _ if word & 0xEF83 == 0x0101 => lowers(bit(12, 5) | u32::from(word >> 2 & 31), 6),
        // C.JALR; register 0 is EBREAK. C.JR; register 1 is a return.
        _ if word & 0xF07F == 0x9002 && register != 0 => Does::CallsRegister,
        _ if word & 0xF07F == 0x8002 && register != 1 => Does::JumpsToRegister,
        // C.MV, C.ADD and C.LI.
        _ if register == 2 && (word & 0xE003 == 0x8002 || word & 0xE003 == 0x4001) => {
            Does::SetsStack
        }
        // C.JAL.
        _ if word & 0xE003 == 0x2001 => Does::Calls(None),
        _ => Does::Else,
    }
}

fn riscv_long(word: u32) -> Does {
    const RA: u32 = 1;
    const SP: u32 = 2;
    let (opcode, to, from) = (word & 0x7F, word >> 7 & 31, word >> 15 & 31);
    match opcode {
        0x13 if to == SP && from == SP && word >> 12 & 7 == 0 => lowers(word >> 20, 12),
        0x03 | 0x13 | 0x17 | 0x33 | 0x37 if to == SP => Does::SetsStack,
        0x67 if to == 0 && from == RA => Does::Else,
        0x67 if to == 0 => Does::JumpsToRegister,
        0x67 => Does::CallsRegister,
        0x6F if to != 0 => Does::Calls(None),
        _ => Does::Else,
    }
}

/// By a signed number of so many bits that is added to the stack pointer.
fn lowers(number: u32, bits: u32) -> Does {
    let above = 1 << bits;
    if number < above / 2 { Does::Else } else { Does::Lowers(above - number) }
}

#[cfg(test)]
mod tests {
    use super::{Does, Set, read};

    fn all(set: Set, code: &[u8]) -> Vec<Does> {
        read(set, code).into_iter().map(|(_, does)| does).collect()
    }

    /// The bytes are those of `arm-none-eabi-as`.
    #[test]
    fn thumb_code_is_read() {
        let code = [
            0xf0, 0xb5, // push {r4-r7, lr}
            0x87, 0xb0, // sub sp, #28
            0x2d, 0xe9, 0x00, 0x0f, // stmdb sp!, {r8-r11}
            0x2d, 0xed, 0x04, 0x8b, // vpush {d8, d9}
            0xad, 0xf5, 0x01, 0x7d, // sub.w sp, sp, #516
            0xad, 0xf2, 0x04, 0x4d, // subw sp, sp, #1028
            0x4d, 0xf8, 0x04, 0xbd, // str.w r11, [sp, #-4]!
            0x85, 0x44, // add sp, r0
            0x98, 0x47, // blx r3
            0x18, 0x47, // bx r3
            0x70, 0x47, // bx lr
            0xf0, 0xbd, // pop {r4-r7, pc}
            0xff, 0xf7, 0xad, 0xfa, // bl, from 0x10dc4 to 0x10322
        ];
        let expected = [
            Does::Lowers(20),
            Does::Lowers(28),
            Does::Lowers(16),
            Does::Lowers(16),
            Does::SetsStack,
            Does::Lowers(1028),
            Does::Lowers(4),
            Does::SetsStack,
            Does::CallsRegister,
            Does::JumpsToRegister,
            Does::Else,
            Does::Else,
            Does::Calls(Some(0x10322 - 0x10dc4)),
        ];
        assert_eq!(all(Set::Thumb, &code), expected);
    }

    /// The bytes are those of `riscv64-unknown-elf-as`.
    #[test]
    fn riscv_code_is_read() {
        let code = [
            0x79, 0x71, // addi sp, sp, -48
            0x41, 0x11, // addi sp, sp, -16
            0x45, 0x61, // addi sp, sp, 48
            0x13, 0x01, 0x01, 0xc1, // addi sp, sp, -1008
            0x82, 0x97, // jalr a5
            0x82, 0x87, // jr a5
            0x82, 0x80, // ret
            0x67, 0x80, 0x07, 0x00, // jr 0(a5)
            0x2e, 0x81, // mv sp, a1
            0xef, 0x00, 0x00, 0x00, // jal ra
        ];
        let expected = [
            Does::Lowers(48),
            Does::Lowers(16),
            Does::Else,
            Does::Lowers(1008),
            Does::CallsRegister,
            Does::JumpsToRegister,
            Does::Else,
            Does::JumpsToRegister,
            Does::SetsStack,
            Does::Calls(None),
        ];
        assert_eq!(all(Set::RiscV, &code), expected);
    }
}
