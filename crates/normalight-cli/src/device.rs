//! Devices: the processor, a real GPU, or slow stand-ins for tests.
use crate::choices::DeviceChoice;
use anyhow::{Result, bail};
use burn::tensor::wgpu::wgpu::{AdapterInfo, DeviceType};
use burn::tensor::{Device, DeviceKind};
use normalight_run::StepsOn;

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
        DeviceChoice::Wgpu => open_gpu(),
        DeviceChoice::Cuda => open_cuda(),
        DeviceChoice::SoftwareGpu => open_software_gpu(),
        DeviceChoice::Reference => Ok(reference()),
    }
}

/// Where an optimiser best computes for a network on a device: where it is, unless that is this processor.
pub(crate) fn steps_on(device: &Device) -> StepsOn {
    match device.identity() {
        Some(_) => StepsOn::Device,
        None => StepsOn::Host,
    }
}

/// Opens several devices of one kind for training; the first is the main one.
pub(crate) fn open_several(choice: DeviceChoice, count: usize) -> Result<Vec<Device>> {
    if count <= 1 {
        return Ok(vec![open(choice)?.device]);
    }
    match choice {
        DeviceChoice::Wgpu => (0..count)
            .map(|index| Ok(open_adapter(DeviceKind::DiscreteGpu(index))?.0))
            .collect(),
        DeviceChoice::Cuda => {
            let devices = cuda_devices()?;
            if devices.len() < count {
                bail!("{count} NVIDIA GPUs wanted, {} found", devices.len());
            }
            Ok(devices.into_iter().take(count).collect())
        }
        // One processor many times is of no use, but shows on any machine how it goes.
        DeviceChoice::Cpu => Ok(vec![cpu().device; count]),
        DeviceChoice::Auto | DeviceChoice::SoftwareGpu | DeviceChoice::Reference => {
            bail!("several devices need --device cuda or wgpu")
        }
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

fn open_cuda() -> Result<OpenDevice> {
    let Some(device) = cuda_devices()?.into_iter().next() else {
        bail!("no NVIDIA GPU found, or not its driver; use --device wgpu or cpu");
    };
    let identity = device.identity().map(|identity| identity.name);
    Ok(OpenDevice {
        device,
        name: format!("GPU ({}, CUDA)", identity.as_deref().unwrap_or("NVIDIA")),
    })
}

/// What the driver lists; a device that is not listed would panic when used.
#[cfg(feature = "cuda")]
fn cuda_devices() -> Result<Vec<Device>> {
    Ok(Device::enumerate(burn::tensor::DeviceType::Cuda).into_vec())
}

#[cfg(not(feature = "cuda"))]
fn cuda_devices() -> Result<Vec<Device>> {
    bail!(
        "this program was built without CUDA; build it with \
         `cargo build --release -p normalight-cli --features cuda`, or use --device wgpu or cpu"
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
    fn steps_stay_on_the_processor() {
        assert_eq!(steps_on(&cpu().device), StepsOn::Host);
        assert_eq!(steps_on(&reference().device), StepsOn::Host);
    }

    #[test]
    fn software_is_no_gpu() {
        assert!(is_real(DeviceType::DiscreteGpu) && is_real(DeviceType::IntegratedGpu));
        assert!(!is_real(DeviceType::Cpu) && !is_real(DeviceType::Other));
    }

    #[test]
    fn several_devices_are_as_many_as_asked_for_or_an_error() {
        assert_eq!(open_several(DeviceChoice::Cpu, 3).unwrap().len(), 3);
        // More than any machine has, or a program without CUDA.
        assert!(open_several(DeviceChoice::Cuda, 1000).is_err());
        assert!(open_several(DeviceChoice::Auto, 2).is_err());
    }
}
