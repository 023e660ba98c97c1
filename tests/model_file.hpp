// A folder with a model and its images, for one test.
#pragma once

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <string>

#include <gtest/gtest.h>
#include <unistd.h>

#include "cotan/image.hpp"
#include "cotan/model.hpp"

namespace cotan {

class ModelFile : public testing::Test {
protected:
    std::filesystem::path folder = std::filesystem::temp_directory_path()
        / ("cotan_model_test_" + std::to_string(::getpid()) + "_"
           + testing::UnitTest::GetInstance()->current_test_info()->name());
    void SetUp() override { std::filesystem::create_directories(folder); }
    void TearDown() override { std::filesystem::remove_all(folder); }

    std::filesystem::path put(const std::string& name, const std::string& text) const
    {
        std::ofstream(folder / name, std::ios::binary) << text;
        return folder / name;
    }

    // Writes an image of one colour.
    void paint(const std::string& name, std::array<int, 3> colour, int width = 4, int height = 4) const
    {
        Image image = makeImage(width, height, PixelType::unorm8);
        for (std::size_t i = 0; i < image.pixelCount(); ++i)
            for (std::size_t c = 0; c < 4; ++c)
                image.bytes8()[4 * i + c] = c < 3 ? std::uint8_t(colour[c]) : 255;
        ASSERT_TRUE(writeImage(folder / name, image));
    }

    Scene get(const std::string& name, const std::string& text, const LoadLimits& limits = {}) const
    {
        auto scene = loadScene(put(name, text), limits);
        if (!scene) {
            ADD_FAILURE() << scene.error().message;
            return {};
        }
        return *std::move(scene);
    }
    std::string refusal(const std::string& name, const std::string& text, const LoadLimits& limits = {}) const
    {
        const auto scene = loadScene(put(name, text), limits);
        return scene ? "" : scene.error().message;
    }

    // A scene with a triangle whose material has these lines.
    Scene paintedBy(const std::string& lines, const LoadLimits& limits = {}) const
    {
        put("m.mtl", "newmtl m\n" + lines);
        return get("model.obj",
                   "mtllib m.mtl\nusemtl m\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n",
                   limits);
    }
    Material materialBy(const std::string& lines) const
    {
        const Scene scene = paintedBy(lines);
        return scene.meshes.empty() ? Material{} : scene.materials.at(std::size_t(scene.meshes[0].material));
    }
};

inline bool says(const Scene& scene, const std::string& text)
{
    return std::ranges::any_of(scene.warnings, [&](const std::string& s) { return s.find(text) != std::string::npos; });
}

} // namespace cotan
