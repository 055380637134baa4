//! What a real board would get from its peripheral access crate: registers, the vector table, the panic handler.

use core::panic::PanicInfo;
use core::ptr::{read_volatile, write_volatile};

/// A block of memory-mapped registers shared with a host and a drive.
pub struct Registers {
    base: *mut u32,
}

impl Registers {
    const ADDRESS: usize = 0x4001_0000;

    fn read(&self, offset: usize) -> u32 {
        // SAFETY: an aligned word of a register block that lives at this address for good.
        unsafe { read_volatile(self.base.add(offset)) }
    }

    fn write(&mut self, offset: usize, value: u32) {
        // SAFETY: as in `read`.
        unsafe { write_volatile(self.base.add(offset), value) }
    }

    fn double(&self, offset: usize) -> f64 {
        f64::from_bits(u64::from(self.read(offset)) | (u64::from(self.read(offset + 1)) << 32))
    }

    /// Distance and limits of velocity, acceleration, jerk and snap, in SI units.
    pub fn request(&self) -> [f64; 5] {
        [self.double(0), self.double(2), self.double(4), self.double(6), self.double(8)]
    }

    /// The law the host asks for.
    pub fn law(&self) -> u32 {
        self.read(10)
    }

    /// Measured position, m.
    pub fn position(&self) -> f32 {
        f32::from_bits(self.read(11))
    }

    #[cfg(feature = "provoke-a-panic")]
    pub fn choice(&self) -> u32 {
        [1, 2, 3][self.read(14) as usize]
    }

    /// Commanded force, N.
    pub fn set_force(&mut self, force: f32) {
        self.write(12, force.to_bits());
    }

    /// Tells the host that its request could not be served.
    pub fn report_fault(&mut self) {
        self.write(13, 1);
    }
}

#[unsafe(no_mangle)]
extern "C" fn reset() -> ! {
    let mut registers = Registers { base: Registers::ADDRESS as *mut u32 };
    let _ = crate::run(&mut registers);
    loop {
        registers.report_fault();
    }
}

#[used]
#[unsafe(link_section = ".vector_table")]
static RESET_VECTOR: extern "C" fn() -> ! = reset;

unsafe extern "C" {
    /// Nowhere defined: a panic that can be reached does not link.
    fn a_panic_can_be_reached() -> !;
}

#[panic_handler]
fn panic(_: &PanicInfo<'_>) -> ! {
    // SAFETY: never linked, so never called.
    unsafe { a_panic_can_be_reached() }
}
