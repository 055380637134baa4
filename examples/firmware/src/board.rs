//! What a real board would get from its peripheral access crate: registers, the vector table, the panic handler.

use core::panic::PanicInfo;
use core::ptr::{read_volatile, write_volatile};

use control::{Phases, Rotation};

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

    fn single(&self, offset: usize) -> f32 {
        f32::from_bits(self.read(offset))
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
        self.single(11)
    }

    #[cfg(feature = "provoke-a-panic")]
    pub fn choice(&self) -> u32 {
        [1, 2, 3][self.read(14) as usize]
    }

    /// Commanded force, N.
    pub fn set_force(&mut self, force: f32) {
        self.write(12, force.to_bits());
    }

    /// Angle of the motor, rad, and its speed, rad/s.
    pub fn motor(&self) -> (f32, f32) {
        (self.single(15), self.single(16))
    }

    /// Currents of the phases, A: two are measured.
    pub fn currents(&self) -> Phases<f32> {
        let (a, b) = (self.single(17), self.single(18));
        Phases { a, b, c: -a - b }
    }

    /// The rotor as the resolver sees it.
    pub fn rotor(&self) -> Rotation<f32> {
        Rotation::from_sin_cos(self.single(19), self.single(20))
    }

    /// Commanded voltages of the phases, V.
    pub fn set_voltages(&mut self, voltages: Phases<f32>) {
        self.write(21, voltages.a.to_bits());
        self.write(22, voltages.b.to_bits());
        self.write(23, voltages.c.to_bits());
    }

    /// The mode of the load, Hz and damping ratio, and the delay of the filter for it, s.
    pub fn mode(&self) -> (f64, f64, f64) {
        (self.double(24), self.double(26), self.double(28))
    }

    /// Whether the profile is shaped ahead of the move instead of tick by tick.
    pub fn shapes_ahead(&self) -> bool {
        self.read(30) != 0
    }

    /// The next pulse of the stepper: timer ticks since the one before, and its direction.
    pub fn pulse(&mut self, ticks: u32, forward: bool) {
        self.write(31, ticks);
        self.write(32, u32::from(forward));
    }

    /// Whether the gantry runs by super-twisting.
    pub fn twists(&self) -> bool {
        self.read(33) != 0
    }

    /// Measured angles of the gantry, rad.
    pub fn gantry(&self) -> [f32; 3] {
        [self.single(34), self.single(35), self.single(36)]
    }

    /// Commanded torques of the gantry, N m.
    pub fn set_torques(&mut self, [x, y, z]: [f32; 3]) {
        self.write(37, x.to_bits());
        self.write(38, y.to_bits());
        self.write(39, z.to_bits());
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
