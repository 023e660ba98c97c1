// Opens, writes and reads back small models in tests of the glTF editor.
#pragma once

#include "cotan/gltf.hpp"
#include "gltf/json/lookup.hpp"
#include "gltf_maker.hpp"

namespace cotan::test {

// The JSON and the buffer of a written model.
struct ReadBack {
    json root;
    std::string buffer;
};

inline std::string wholeFile(const std::filesystem::path& file)
{
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

inline std::uint32_t wordAt(const std::string& bytes, std::size_t at)
{
    std::uint32_t value = 0;
    std::memcpy(&value, bytes.data() + at, 4);
    return value;
}

inline ReadBack readBack(const std::filesystem::path& file)
{
    const std::string bytes = wholeFile(file);
    if (file.extension() == ".gltf") {
        ReadBack r{json::parse(bytes), {}};
        if (r.root.contains("buffers"))
            r.buffer = wholeFile(file.parent_path() / r.root["buffers"][0]["uri"]);
        return r;
    }
    const std::size_t length = wordAt(bytes, 12);
    ReadBack r{json::parse(bytes.substr(20, length)), {}};
    if (20 + length < bytes.size())
        r.buffer = bytes.substr(28 + length, r.root["buffers"][0]["byteLength"]);
    return r;
}

// The raw bytes of each element of an accessor without sparse values.
inline std::vector<std::string> elements(const ReadBack& model, int accessor, std::size_t size)
{
    const json& a = model.root["accessors"][accessor];
    const json& v = model.root["bufferViews"][a["bufferView"].get<int>()];
    const std::size_t stride = v.value("byteStride", size);
    std::vector<std::string> out;
    for (std::size_t i = 0; i < a["count"]; ++i)
        out.push_back(model.buffer.substr(v.value("byteOffset", 0u) + a.value("byteOffset", 0u) + i * stride, size));
    return out;
}

inline std::vector<float> floatsOf(const ReadBack& model, int accessor, std::size_t components)
{
    std::vector<float> out;
    for (const std::string& e : elements(model, accessor, components * 4))
        for (std::size_t c = 0; c < components; ++c) {
            float x = 0;
            std::memcpy(&x, e.data() + 4 * c, 4);
            out.push_back(x);
        }
    return out;
}

inline std::vector<std::uint16_t> shortsOf(const ReadBack& model, int accessor)
{
    std::vector<std::uint16_t> out;
    for (const std::string& e : elements(model, accessor, 2)) {
        std::uint16_t x = 0;
        std::memcpy(&x, e.data(), 2);
        out.push_back(x);
    }
    return out;
}

inline Result<GltfDocument> openText(const TemporaryFolder& folder, const std::string& text,
                                     const std::string& name = "model.gltf")
{
    return openGltfDocument(folder.write(name, text));
}

// One tangent for each corner of the square's two triangles; vertices 0 and 2 are shared.
inline std::vector<glm::vec4> cornersOf(std::initializer_list<float> signs)
{
    std::vector<glm::vec4> corners;
    for (const float w : signs)
        corners.emplace_back(1, 0, 0, w);
    return corners;
}

} // namespace cotan::test
