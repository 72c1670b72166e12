//! Devices: the processor, a real GPU, or slow stand-ins for tests.
use crate::choices::DeviceChoice;
use anyhow::{Result, bail};
use burn::tensor::wgpu::wgpu::{AdapterInfo, DeviceType};
use burn::tensor::{Device, DeviceKind};

/// A device ready for use, and what reports call it.
pub(crate) struct OpenDevice {
    pub(crate) device: Device,
    pub(crate) name: String,
}

/// Opens the device that was asked for.
pub(crate) fn open(choice: DeviceChoice) -> Result<OpenDevice> {
    match choice {
        DeviceChoice::Auto => Ok(open_gpu().unwrap_or_else(|_| cpu())),
        DeviceChoice::Cpu => Ok(cpu()),
        DeviceChoice::Gpu => open_gpu(),
        DeviceChoice::SoftwareGpu => open_software_gpu(),
        DeviceChoice::Reference => Ok(reference()),
    }
}

fn cpu() -> OpenDevice {
    OpenDevice {
        device: Device::flex(),
        name: "CPU (flex)".to_owned(),
    }
}

#[expect(
    deprecated,
    reason = "the reference is pinned to the last Burn that has it"
)]
fn reference() -> OpenDevice {
    OpenDevice {
        device: Device::ndarray(),
        name: "CPU (ndarray, reference)".to_owned(),
    }
}

/// Opens what Burn finds best, which is a software adapter only where nothing else is.
fn open_gpu() -> Result<OpenDevice> {
    let (device, adapter) = open_adapter(DeviceKind::DefaultDevice)?;
    if is_real(adapter.device_type) {
        return Ok(named(device, &adapter));
    }
    bail!(
        "no GPU found, only {} ({:?}); use --device cpu",
        adapter.name,
        adapter.device_type
    )
}

fn open_software_gpu() -> Result<OpenDevice> {
    let (device, adapter) = open_adapter(DeviceKind::Cpu)?;
    Ok(named(device, &adapter))
}

/// Adapters of unknown type may be software, so they do not count.
fn is_real(kind: DeviceType) -> bool {
    match kind {
        DeviceType::DiscreteGpu | DeviceType::IntegratedGpu | DeviceType::VirtualGpu => true,
        DeviceType::Cpu | DeviceType::Other => false,
    }
}

fn open_adapter(kind: DeviceKind) -> Result<(Device, AdapterInfo)> {
    match Device::wgpu_options().device_kind(kind).init_with_setup() {
        Ok((device, setup)) => Ok((device, setup.adapter.get_info())),
        Err(error) => bail!("no GPU can be used ({error}); use --device cpu"),
    }
}

fn named(device: Device, adapter: &AdapterInfo) -> OpenDevice {
    let kind = if is_real(adapter.device_type) {
        "GPU"
    } else {
        "software GPU"
    };
    OpenDevice {
        device,
        name: format!("{kind} ({}, {:?})", adapter.name, adapter.backend),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn software_is_no_gpu() {
        assert!(is_real(DeviceType::DiscreteGpu) && is_real(DeviceType::IntegratedGpu));
        assert!(!is_real(DeviceType::Cpu) && !is_real(DeviceType::Other));
    }
}
