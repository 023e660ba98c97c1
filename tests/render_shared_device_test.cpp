// Renderers on the device of a window: images that stay on it, and threads that share its queue.
#include <atomic>
#include <cstring>
#include <thread>

#include "memory.hpp"
#include "render/shared_device.hpp"
#include "render_scene.hpp"

namespace cotan {

using namespace rendertest;

namespace {

// A window that exists only for the choice of a device.
std::shared_ptr<Device> openForWindow(const std::string& name, bool validation = true)
{
    const WindowNeeds window{
        {"VK_KHR_surface"},
        [](const vk::raii::Instance&, const vk::raii::PhysicalDevice&, std::uint32_t) { return true; }};
    auto device = openDevice(name, validation, &window);
    return device ? std::shared_ptr<Device>(std::move(*device)) : nullptr;
}

// Reads an image as the window does, with commands of its own.
Image readOnDevice(const Device& device, const DeviceImage& from)
{
    Commands commands(device);
    Memory memory(device, 0);
    const vk::Extent2D size = from.texture.extent;
    Image image = makeImage(int(size.width), int(size.height), PixelType::unorm8);
    const Buffer copy = makeHostBuffer(memory, image.data.size(), vk::BufferUsageFlagBits::eTransferDst, true);
    copyToHost(commands.begin(), device, *from.texture.image, size, copy);
    commands.submitAndWait();
    std::memcpy(image.data.data(), copy.mapped, image.data.size());
    return image;
}

View viewFrom(float x, int width = 96, int height = 64)
{
    View view;
    view.width = width;
    view.height = height;
    view.camera.eye = {x, 1, 3};
    return view;
}

TEST(RenderSharedDevice, heldImagesKeepTheirPixelsWhileOthersAreDrawn)
{
    const auto device = openForWindow("");
    if (!device)
        GTEST_SKIP() << "no Vulkan device";
    const Scene scene = sceneOf(sphere(12));
    auto first = openRendererOn(device), second = openRendererOn(device);
    ASSERT_TRUE(first && *first && second && *second);
    ASSERT_TRUE((*first)->load(scene) && (*second)->load(scene));
    std::vector<std::shared_ptr<const DeviceImage>> held;
    std::vector<Image> expected;
    for (const float x : {0.0f, 1.0f, 2.0f})
        for (auto* renderer : {&**first, &**second}) {
            auto drawn = drawOnDevice(*renderer, viewFrom(x));
            ASSERT_TRUE(drawn && *drawn);
            held.push_back(*drawn);
        }
    EXPECT_EQ(device->imagesRead, 0u);
    for (const float x : {0.0f, 1.0f, 2.0f})
        expected.push_back(*(*first)->draw(viewFrom(x)));
    EXPECT_EQ(device->imagesRead, 3u);
    EXPECT_FALSE(expected[0].data == expected[1].data);
    for (std::size_t i = 0; i < held.size(); ++i)
        EXPECT_TRUE(readOnDevice(*device, *held[i]).data == expected[i / 2].data) << i;
    const DeviceImage* const freed = held[0].get();
    held[0].reset();
    for (int i = 0; i < 3; ++i) // an image that nobody holds is used again
        EXPECT_EQ(drawOnDevice(**first, viewFrom(1))->get(), freed);
    for (const std::string& message : *device->messages)
        ADD_FAILURE() << message;
}

TEST(RenderSharedDevice, twoThreadsUseItsQueue)
{
    const auto device = openForWindow("");
    if (!device)
        GTEST_SKIP() << "no Vulkan device";
    auto renderer = openRendererOn(device);
    ASSERT_TRUE(renderer && *renderer);
    const Scene scene = sceneOf(sphere(12));
    ASSERT_TRUE((*renderer)->load(scene));
    const auto shown = *drawOnDevice(**renderer, viewFrom(0));
    const Image expected = readOnDevice(*device, *shown);
    std::atomic<bool> drawing = true;
    int read = 0;
    std::thread window([&] {
        for (; drawing || read == 0; ++read)
            EXPECT_TRUE(readOnDevice(*device, *shown).data == expected.data);
    });
    for (int i = 0; i < 20; ++i)
        EXPECT_TRUE(*drawOnDevice(**renderer, viewFrom(float(i))));
    drawing = false;
    window.join();
    for (const std::string& message : *device->messages)
        ADD_FAILURE() << message;
}

// A CPU draws large images for a window in bands, between which the window can use the queue.
TEST(RenderSharedDevice, bandsDrawTheSameBytes)
{
    const auto device = openForWindow("");
    if (!device)
        GTEST_SKIP() << "no Vulkan device";
    auto banded = openRendererOn(device);
    auto whole = openRenderer(device->name);
    ASSERT_TRUE(banded && *banded && whole);
    const Scene scene = sceneOf(sphere(12), flatImage(texelOf({0.3f, 0.1f, 1})));
    ASSERT_TRUE((*banded)->load(scene) && (*whole)->load(scene));
    for (const int samples : {1, 4}) {
        View view = viewFrom(1, 1031, 613); // 240 rows of one sample are drawn at once
        view.samples = samples;
        const auto drawn = drawOnDevice(**banded, view);
        ASSERT_TRUE(drawn && *drawn);
        EXPECT_TRUE(readOnDevice(*device, **drawn).data == (*whole)->draw(view)->data) << samples;
    }
    for (const std::string& message : *device->messages)
        ADD_FAILURE() << message;
}

TEST(RenderSharedDevice, hostsFinishWhatDevicesCannot)
{
    const auto device = openForWindow("");
    if (!device)
        GTEST_SKIP() << "no Vulkan device";
    auto renderer = openRendererOn(device);
    auto reference = openRenderer("reference");
    ASSERT_TRUE(renderer && *renderer && reference);
    const Scene scene = sceneOf(sphere(6));
    ASSERT_TRUE((*renderer)->load(scene) && (*reference)->load(scene));
    View many = viewFrom(0), normals = many, light = many;
    many.samples = 16;
    normals.output = Output::normal;
    light.linearOutput = true;
    for (const View& view : {many, normals, light}) {
        const auto drawn = drawOnDevice(**renderer, view);
        ASSERT_TRUE(drawn) << drawn.error().message;
        EXPECT_FALSE(*drawn);
    }
    const auto drawn = drawOnDevice(**reference, viewFrom(0));
    ASSERT_TRUE(drawn);
    EXPECT_FALSE(*drawn);
    View wrong = viewFrom(0);
    wrong.width = 0;
    const auto refused = drawOnDevice(**renderer, wrong);
    EXPECT_FALSE(refused);
}

TEST(RenderSharedDevice, windowsUseADeviceThatCanPresent)
{
    const auto best = openForWindow(""), other = openForWindow("no such device");
    if (!best)
        GTEST_SKIP() << "no Vulkan device";
    ASSERT_TRUE(other);
    EXPECT_TRUE(best->asAsked);
    EXPECT_FALSE(other->asAsked);
    const WindowNeeds nowhere{
        {"VK_KHR_surface"},
        [](const vk::raii::Instance&, const vk::raii::PhysicalDevice&, std::uint32_t) { return false; }};
    const auto none = openDevice("", false, &nowhere);
    ASSERT_FALSE(none);
    EXPECT_EQ(none.error().kind, ErrorKind::unavailable);
    EXPECT_NE(none.error().message.find("present in a window"), std::string::npos) << none.error().message;
}

} // namespace
} // namespace cotan
