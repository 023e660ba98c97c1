#include "devices.hpp"

#include <algorithm>
#include <cstring>
#include <utility>

#include "core/named_values.hpp"

namespace cotan::cost {

namespace {

bool hasExtension(const vk::raii::PhysicalDevice& physical, const char* name)
{
    for (const vk::ExtensionProperties& e : physical.enumerateDeviceExtensionProperties())
        if (std::strcmp(e.extensionName, name) == 0)
            return true;
    return false;
}

// Returns the vendor's name by its PCI number, or by the driver's name for drivers that report Mesa's own number.
std::string makerOf(std::uint32_t vendor, std::string_view driver)
{
    constexpr std::pair<std::uint32_t, const char*> kMakers[] = {
        {0x1002, "AMD"},   {0x10de, "NVIDIA"}, {0x8086, "Intel"},        {0x5143, "Qualcomm"},
        {0x106b, "Apple"}, {0x13b5, "Arm"},    {0x14e4, "Raspberry Pi"}, {0x1010, "Imagination"}};
    for (const auto& [number, name] : kMakers)
        if (number == vendor)
            return name;
    return driver.rfind("Honeykrisp", 0) == 0 ? "Apple" : "";
}

Device describe(vk::raii::PhysicalDevice physical)
{
    Device d;
    const vk::PhysicalDeviceProperties core = physical.getProperties();
    if (core.apiVersion >= VK_API_VERSION_1_2 || hasExtension(physical, VK_KHR_DRIVER_PROPERTIES_EXTENSION_NAME)) {
        const auto both = physical.getProperties2<vk::PhysicalDeviceProperties2, vk::PhysicalDeviceDriverProperties>();
        const auto& driver = both.get<vk::PhysicalDeviceDriverProperties>();
        d.driver = std::string(driver.driverName.data()) + ", " + std::string(driver.driverInfo.data());
        d.radv = driver.driverID == vk::DriverId::eMesaRadv;
    }
    d.name = core.deviceName.data();
    d.name.erase(d.name.find_last_not_of(' ') + 1);
    d.maker = makerOf(core.vendorID, d.driver);
    d.cpu = core.deviceType == vk::PhysicalDeviceType::eCpu;
    d.reports = hasExtension(physical, VK_KHR_PIPELINE_EXECUTABLE_PROPERTIES_EXTENSION_NAME);
    d.meshShaders = hasExtension(physical, VK_EXT_MESH_SHADER_EXTENSION_NAME);
    d.dynamicRendering = core.apiVersion >= VK_API_VERSION_1_3;
    d.missing = d.dynamicRendering ? "has no graphics queue" : "needs Vulkan 1.3";
    const auto families = physical.getQueueFamilyProperties();
    for (std::size_t i = 0; i < families.size(); ++i)
        if (families[i].queueFlags & vk::QueueFlagBits::eGraphics) {
            d.queueFamily = static_cast<std::uint32_t>(i);
            d.compiles = true;
            if (d.dynamicRendering)
                d.missing.clear();
            if (families[i].timestampValidBits > 0)
                d.nanoseconds = double(core.limits.timestampPeriod);
            break;
        }
    d.physical = std::move(physical);
    return d;
}

} // namespace

Instance openInstance()
{
    Instance i;
    const vk::ApplicationInfo application("cotan cost", 1, "cotan", 1, VK_API_VERSION_1_3);
    i.instance = vk::raii::Instance(i.context, vk::InstanceCreateInfo({}, &application));
    return i;
}

std::vector<Device> listDevices(const Instance& instance)
{
    std::vector<Device> devices;
    for (vk::raii::PhysicalDevice& physical : vk::raii::PhysicalDevices(instance.instance))
        devices.push_back(describe(std::move(physical)));
    std::stable_partition(devices.begin(), devices.end(), [](const Device& d) { return !d.cpu; });
    return devices;
}

void open(Device& d)
{
    const auto has = d.physical.getFeatures();
    vk::PhysicalDeviceVulkan13Features use13;
    use13.dynamicRendering = VK_TRUE;
    use13.synchronization2 = VK_TRUE;
    use13.shaderDemoteToHelperInvocation = VK_TRUE; // newer glslang compiles discard to this
    use13.maintenance4 = VK_TRUE;                   // work group sizes as SPIR-V for 1.3 states them
    vk::PhysicalDevicePipelineExecutablePropertiesFeaturesKHR report(VK_TRUE);
    vk::PhysicalDeviceMeshShaderFeaturesEXT mesh(VK_FALSE, VK_TRUE);
    vk::PhysicalDeviceVulkan12Features use12;
    use12.bufferDeviceAddress = VK_TRUE; // every Vulkan 1.3 device has it
    use12.pNext = &use13;
    vk::PhysicalDeviceFeatures2 use;
    use.features.geometryShader = has.geometryShader; // needed to read gl_PrimitiveID
    if (d.dynamicRendering)                           // older drivers refuse unknown structures
        use.pNext = &use12;
    std::vector<const char*> extensions;
    if (d.reports) {
        extensions.push_back(VK_KHR_PIPELINE_EXECUTABLE_PROPERTIES_EXTENSION_NAME);
        report.pNext = std::exchange(use.pNext, &report);
    }
    if (d.meshShaders) {
        extensions.push_back(VK_EXT_MESH_SHADER_EXTENSION_NAME);
        mesh.pNext = std::exchange(use.pNext, &mesh);
    }
    const float priority = 1;
    const vk::DeviceQueueCreateInfo queue({}, d.queueFamily, 1, &priority);
    d.opened = std::make_unique<cotan::Device>();
    d.opened->physical = d.physical;
    d.opened->device = vk::raii::Device(d.physical, vk::DeviceCreateInfo({}, queue, {}, extensions, {}, &use));
    d.opened->queue = d.opened->device.getQueue(d.queueFamily, 0);
    d.opened->queueFamily = d.queueFamily;
    d.opened->limits = d.physical.getProperties().limits;
    d.opened->memory = d.physical.getMemoryProperties();
}

bool wanted(const std::string& name, const std::vector<std::string>& names)
{
    return names.empty() || std::any_of(names.begin(), names.end(), [&](const std::string& n) {
               return lowerCase(name).find(lowerCase(n)) != std::string::npos;
           });
}

} // namespace cotan::cost
