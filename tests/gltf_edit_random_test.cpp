// Random documents through the editor and back: views that overlap, interleave and leave gaps in several buffers,
// accessors of many types, sparse ones, morph targets. A small reader in this file reads the data of every triangle
// corner before and after; they must be bitwise equal.
#include <algorithm>
#include <map>
#include <random>

#include "gltf_edit_maker.hpp"

namespace {

using namespace cotan::test;

class Dice {
public:
    explicit Dice(std::uint32_t seed) : bits_(seed) {}
    std::size_t below(std::size_t end) { return bits_() % end; }
    bool heads() { return below(2) == 0; }
    float real() { return float(int(bits_() % 2001) - 1000) / 64; }

private:
    std::mt19937 bits_;
};

std::size_t sizeOf(int componentType)
{
    const std::map<int, std::size_t> sizes = {{5120, 1}, {5121, 1}, {5122, 2}, {5123, 2}, {5125, 4}, {5126, 4}};
    return sizes.at(componentType);
}

std::size_t elementSize(const json& accessor)
{
    const std::map<std::string, std::size_t> counts = {{"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}};
    return counts.at(accessor["type"]) * sizeOf(accessor["componentType"]);
}

struct Files {
    json root;
    std::vector<std::string> buffers;
};

// The bytes of every element of an accessor, by the specification.
std::vector<std::string> read(const Files& files, std::size_t index)
{
    const json& a = files.root["accessors"][index];
    const std::size_t size = elementSize(a), count = a["count"];
    const auto run = [&](const json& from, std::size_t each, std::size_t number) {
        const json& view = files.root["bufferViews"][from["bufferView"].get<std::size_t>()];
        const std::string& buffer = files.buffers[view["buffer"].get<std::size_t>()];
        const std::size_t stride = view.value("byteStride", each);
        std::vector<std::string> all;
        for (std::size_t i = 0; i < number; ++i)
            all.push_back(
                buffer.substr(view.value("byteOffset", 0u) + from.value("byteOffset", 0u) + i * stride, each));
        return all;
    };
    std::vector<std::string> values(count, std::string(size, '\0'));
    if (a.contains("bufferView"))
        values = run(a, size, count);
    if (a.contains("sparse")) {
        const json& s = a["sparse"];
        const std::size_t width = sizeOf(s["indices"]["componentType"]), number = s["count"];
        const auto at = run(s["indices"], width, number), with = run(s["values"], size, number);
        for (std::size_t i = 0; i < number; ++i) {
            std::uint32_t vertex = 0;
            std::memcpy(&vertex, at[i].data(), width);
            values[vertex] = with[i];
        }
    }
    return values;
}

// The bytes of every attribute and target at a triangle corner, by name.
using Corner = std::map<std::string, std::string>;
std::vector<Corner> cornersIn(const Files& files, const json& primitive)
{
    std::map<std::string, std::vector<std::string>> all;
    const auto take = [&](const json& attributes, const std::string& before) {
        for (const auto& [name, accessor] : attributes.items())
            all[before + name] = read(files, accessor);
    };
    take(primitive["attributes"], "");
    for (std::size_t t = 0; primitive.contains("targets") && t < primitive["targets"].size(); ++t)
        take(primitive["targets"][t], "target " + std::to_string(t) + " ");
    std::vector<std::size_t> vertices;
    if (primitive.contains("indices"))
        for (const std::string& bytes : read(files, primitive["indices"])) {
            std::uint32_t index = 0;
            std::memcpy(&index, bytes.data(), bytes.size());
            vertices.push_back(index);
        }
    else
        for (std::size_t i = 0; i < all.begin()->second.size(); ++i)
            vertices.push_back(i);
    std::vector<Corner> corners;
    for (const std::size_t v : vertices) {
        Corner& corner = corners.emplace_back();
        for (const auto& [name, values] : all)
            corner[name] = values.at(v);
    }
    return corners;
}

class Maker {
public:
    explicit Maker(std::uint32_t seed) : dice_(seed)
    {
        files_.root = {{"asset", {{"version", "2.0"}}}, {"scene", 0}};
        files_.buffers.resize(1 + dice_.below(3));
        const std::size_t meshes = 1 + dice_.below(3);
        for (std::size_t m = 0; m < meshes; ++m) {
            json mesh = {{"name", "mesh " + std::to_string(m)}};
            for (std::size_t p = 0; p <= dice_.below(2); ++p)
                mesh["primitives"].push_back(primitive());
            files_.root["meshes"].push_back(mesh);
            files_.root["nodes"].push_back({{"mesh", m}});
            files_.root["scenes"][0]["nodes"].push_back(m);
        }
        for (std::string& buffer : files_.buffers) {
            buffer += std::string(4 * dice_.below(3) + 1, 'x'); // gaps at the end, too
            files_.root["buffers"].push_back({{"byteLength", buffer.size()}});
        }
    }

    Files files() const { return files_; }

private:
    // Appends the bytes after a gap, at a multiple of four in a random buffer.
    std::size_t view(const std::string& bytes, std::size_t stride)
    {
        const std::size_t b = dice_.below(files_.buffers.size());
        std::string& buffer = files_.buffers[b];
        buffer.resize((buffer.size() + 3) / 4 * 4 + 4 * dice_.below(3), 'g');
        json made = {{"buffer", b}, {"byteLength", bytes.size()}};
        if (!buffer.empty() || dice_.heads())
            made["byteOffset"] = buffer.size();
        if (stride > 0)
            made["byteStride"] = stride;
        buffer += bytes;
        files_.root["bufferViews"].push_back(made);
        return files_.root["bufferViews"].size() - 1;
    }

    std::string element(const json& accessor)
    {
        std::string bytes;
        const std::size_t width = sizeOf(accessor["componentType"]);
        for (std::size_t c = 0; c < elementSize(accessor) / width; ++c) {
            const float real = dice_.real();
            const std::uint32_t whole = std::uint32_t(dice_.below(120));
            char raw[4];
            std::memcpy(raw, accessor["componentType"] == 5126 ? (const void*)&real : (const void*)&whole, 4);
            bytes.append(raw, width);
        }
        return bytes;
    }

    std::size_t vertexAccessor(std::size_t count, int componentType, const char* type, bool bounds)
    {
        json a = {{"componentType", componentType}, {"type", type}, {"count", count}};
        if (componentType != 5126)
            a["normalized"] = true;
        const std::size_t size = elementSize(a), offset = 4 * dice_.below(2);
        const std::size_t stride = (size + 3) / 4 * 4 + 4 * dice_.below(3) + offset;
        std::string bytes(stride * count, 'i');
        for (std::size_t i = 0; i < count; ++i)
            bytes.replace(i * stride + offset, size, element(a));
        a["bufferView"] = view(bytes, stride);
        if (offset > 0)
            a["byteOffset"] = offset;
        if (dice_.below(4) == 0) {
            std::string sparseIndices, values;
            std::size_t number = 0;
            for (std::size_t i = 0; i < count; ++i)
                if (dice_.below(3) == 0) {
                    sparseIndices += char(i);
                    values += element(a);
                    ++number;
                }
            if (number > 0)
                a["sparse"] = {{"count", number},
                               {"indices", {{"bufferView", view(sparseIndices, 0)}, {"componentType", 5121}}},
                               {"values", {{"bufferView", view(values, 0)}}}};
        }
        files_.root["accessors"].push_back(a);
        const std::size_t made = files_.root["accessors"].size() - 1;
        if (bounds)
            addBounds(made);
        return made;
    }

    // Adds two accessors whose views overlap: the second starts inside the first and ends after it.
    void addOverlapping(json& attributes, std::size_t count)
    {
        const std::size_t behind = 1 + dice_.below(count);
        json a = {{"componentType", 5126}, {"type", "VEC3"}, {"count", count}};
        std::string bytes;
        for (std::size_t i = 0; i < count + behind; ++i)
            bytes += element(a);
        const std::size_t all = view(bytes, 0);
        json first = files_.root["bufferViews"][all], second = first;
        first["byteLength"] = second["byteLength"] = 12 * count;
        second["byteOffset"] = first.value("byteOffset", 0u) + 12 * behind;
        files_.root["bufferViews"][all] = first;
        files_.root["bufferViews"].push_back(second);
        for (const auto& [name, number] : {std::pair("_FIRST", all), {"_SECOND", all + 1}}) {
            a["bufferView"] = number;
            files_.root["accessors"].push_back(a);
            attributes[name] = files_.root["accessors"].size() - 1;
        }
    }

    void addBounds(std::size_t accessor)
    {
        std::vector<float> low(3, 1e30f), high(3, -1e30f);
        for (const std::string& e : read(files_, accessor))
            for (std::size_t c = 0; c < 3; ++c) {
                float x = 0;
                std::memcpy(&x, e.data() + 4 * c, 4);
                low[c] = std::min(low[c], x), high[c] = std::max(high[c], x);
            }
        files_.root["accessors"][accessor]["min"] = low;
        files_.root["accessors"][accessor]["max"] = high;
    }

    json primitive()
    {
        const std::size_t count = 3 * (1 + dice_.below(6));
        json p;
        p["attributes"]["POSITION"] = vertexAccessor(count, 5126, "VEC3", true);
        p["attributes"]["NORMAL"] = vertexAccessor(count, 5126, "VEC3", false);
        const int uvTypes[] = {5126, 5121, 5123};
        p["attributes"]["TEXCOORD_0"] = vertexAccessor(count, uvTypes[dice_.below(3)], "VEC2", false);
        if (dice_.heads())
            p["attributes"]["COLOR_0"] = vertexAccessor(count, dice_.heads() ? 5121 : 5126, "VEC4", false);
        if (dice_.below(3) == 0)
            p["attributes"]["_ODD"] = vertexAccessor(count, 5126, "SCALAR", false);
        if (dice_.heads())
            addOverlapping(p["attributes"], count);
        if (dice_.below(3) == 0)
            p["targets"] = {{{"POSITION", vertexAccessor(count, 5126, "VEC3", true)}}};
        if (dice_.below(4) != 0) {
            const int type = dice_.heads() ? 5121 : dice_.heads() ? 5123 : 5125;
            const std::size_t triangles = 1 + dice_.below(8);
            std::string bytes;
            for (std::size_t i = 0; i < 3 * triangles; ++i) {
                const std::uint32_t index = std::uint32_t(dice_.below(count));
                bytes.append(reinterpret_cast<const char*>(&index), sizeOf(type));
            }
            files_.root["accessors"].push_back({{"componentType", type},
                                                {"type", "SCALAR"},
                                                {"count", 3 * triangles},
                                                {"bufferView", view(bytes, 0)}});
            p["indices"] = files_.root["accessors"].size() - 1;
        }
        return p;
    }

    Dice dice_;
    Files files_;
};

cotan::Result<cotan::GltfDocument> opened(const TemporaryFolder& folder, Files files)
{
    for (std::size_t b = 0; b < files.buffers.size(); ++b) {
        const std::string name = "part " + std::to_string(b) + ".bin";
        folder.write(name, files.buffers[b]);
        files.root["buffers"][b]["uri"] = "part%20" + std::to_string(b) + ".bin";
    }
    return openText(folder, files.root.dump());
}

Files writtenAs(const TemporaryFolder& folder, cotan::GltfDocument& document, const char* name)
{
    const auto done = cotan::writeGltf(document, folder.path / name);
    EXPECT_TRUE(done) << done.error().message;
    const auto loaded = cotan::loadGltf(folder.path / name);
    EXPECT_TRUE(loaded) << loaded.error().message;
    const ReadBack back = readBack(folder.path / name);
    EXPECT_EQ(back.root["buffers"].size(), 1u);
    EXPECT_EQ(back.root["buffers"][0]["byteLength"], back.buffer.size());
    return {back.root, {back.buffer}};
}

// Expects exact bounds, and every accessor and view inside its container and aligned.
void expectSound(const Files& files)
{
    for (std::size_t a = 0; a < files.root["accessors"].size(); ++a) {
        const json& accessor = files.root["accessors"][a];
        const json& view = files.root["bufferViews"][accessor["bufferView"].get<std::size_t>()];
        const std::size_t size = elementSize(accessor), count = accessor["count"];
        const std::size_t end = accessor.value("byteOffset", 0u) + (count - 1) * view.value("byteStride", size) + size;
        EXPECT_LE(end, view["byteLength"].get<std::size_t>()) << a;
        EXPECT_LE(view.value("byteOffset", 0u) + view["byteLength"].get<std::size_t>(), files.buffers[0].size());
        EXPECT_EQ((view.value("byteOffset", 0u) + accessor.value("byteOffset", 0u)) % sizeOf(accessor["componentType"]),
                  0u);
        if (!accessor.contains("min"))
            continue;
        std::vector<float> low(3, 1e30f), high(3, -1e30f);
        for (const std::string& e : read(files, a))
            for (std::size_t c = 0; c < 3; ++c) {
                float x = 0;
                std::memcpy(&x, e.data() + 4 * c, 4);
                low[c] = std::min(low[c], x), high[c] = std::max(high[c], x);
            }
        EXPECT_EQ(accessor["min"].get<std::vector<float>>(), low) << a;
        EXPECT_EQ(accessor["max"].get<std::vector<float>>(), high) << a;
    }
}

template<class Look> void forEachPrimitive(const Files& before, const Files& after, const Look& look)
{
    ASSERT_EQ(after.root["meshes"].size(), before.root["meshes"].size());
    for (std::size_t m = 0; m < before.root["meshes"].size(); ++m) {
        const json &old = before.root["meshes"][m]["primitives"], &now = after.root["meshes"][m]["primitives"];
        ASSERT_EQ(now.size(), old.size());
        for (std::size_t p = 0; p < old.size(); ++p)
            look(m, p, cornersIn(before, old[p]), cornersIn(after, now[p]));
    }
}

TEST(GltfEditRandom, everyCornerKeepsItsAttributesWhenWritten)
{
    for (std::uint32_t seed = 1; seed <= 40; ++seed) {
        const TemporaryFolder folder;
        const Files before = Maker(seed).files();
        for (const char* name : {"out.glb", "other/out.gltf"}) {
            auto document = opened(folder, before);
            ASSERT_TRUE(document) << document.error().message;
            std::filesystem::create_directories(folder.path / "other");
            const Files after = writtenAs(folder, *document, name);
            expectSound(after);
            forEachPrimitive(before, after, [&](std::size_t, std::size_t, const auto& old, const auto& now) {
                EXPECT_EQ(now, old) << "seed " << seed;
            });
        }
    }
}

// The numbers of an element; integers are normalised.
std::vector<float> decoded(const std::string& bytes, int componentType)
{
    std::vector<float> numbers;
    for (std::size_t at = 0; at < bytes.size(); at += sizeOf(componentType)) {
        std::uint32_t whole = 0;
        std::memcpy(&whole, bytes.data() + at, sizeOf(componentType));
        float real = 0;
        std::memcpy(&real, &whole, 4);
        numbers.push_back(componentType == 5126 ? real : float(whole) / (componentType == 5121 ? 255.0f : 65535.0f));
    }
    return numbers;
}

template<int N> void expectNumbers(const std::vector<float>& numbers, const glm::vec<N, float>& found)
{
    ASSERT_GE(numbers.size(), std::size_t(N));
    for (int c = 0; c < N; ++c)
        EXPECT_FLOAT_EQ(found[c], numbers[std::size_t(c)]);
}

TEST(GltfEditRandom, theSceneHasTheAttributesOfTheFileAtEveryCorner)
{
    std::size_t corners = 0, colored = 0;
    for (std::uint32_t seed = 1; seed <= 40; ++seed) {
        const TemporaryFolder folder;
        const Files files = Maker(seed).files();
        auto document = opened(folder, files); // also writes the buffers
        ASSERT_TRUE(document) << document.error().message;
        ASSERT_TRUE(cotan::writeGltf(*document, folder.path / "in.gltf"));
        const auto scene = cotan::loadGltf(folder.path / "in.gltf");
        ASSERT_TRUE(scene) << scene.error().message;
        ASSERT_EQ(scene->instances.size(), scene->meshes.size());
        std::size_t at = 0;
        for (const json& mesh : files.root["meshes"])
            for (const json& primitive : mesh["primitives"]) {
                ASSERT_LT(at, scene->meshes.size());
                const cotan::Mesh& m = scene->meshes[at++];
                const auto expected = cornersIn(files, primitive);
                ASSERT_EQ(m.indices.size(), expected.size()) << "seed " << seed;
                const auto typeOf = [&](const char* name) {
                    return files.root["accessors"][primitive["attributes"][name].get<std::size_t>()]["componentType"]
                        .get<int>();
                };
                for (std::size_t k = 0; k < expected.size(); ++k) {
                    const std::uint32_t v = m.indices[k];
                    expectNumbers<3>(decoded(expected[k].at("POSITION"), 5126), m.positions[v]);
                    const std::vector<float> n = decoded(expected[k].at("NORMAL"), 5126);
                    const glm::vec3 unit = glm::normalize(glm::vec3(n[0], n[1], n[2]));
                    EXPECT_LT(glm::distance(m.normals[v], unit), 1e-6f);
                    expectNumbers<2>(decoded(expected[k].at("TEXCOORD_0"), typeOf("TEXCOORD_0")), m.texcoords[0][v]);
                    if (expected[k].contains("COLOR_0")) {
                        expectNumbers<4>(decoded(expected[k].at("COLOR_0"), typeOf("COLOR_0")), m.colors[v]);
                        ++colored;
                    } else {
                        EXPECT_TRUE(m.colors.empty());
                    }
                    ++corners;
                }
            }
        EXPECT_EQ(at, scene->meshes.size());
    }
    EXPECT_GT(corners, 1000u);
    EXPECT_GT(colored, 200u);
}

TEST(GltfEditRandom, settingCornerTangentsChangesNothingElse)
{
    for (std::uint32_t seed = 1; seed <= 40; ++seed) {
        const TemporaryFolder folder;
        const Files before = Maker(seed).files();
        auto document = opened(folder, before);
        ASSERT_TRUE(document);
        Dice dice(seed + 1000);
        std::map<std::pair<std::size_t, std::size_t>, std::vector<glm::vec4>> given;
        std::vector<cotan::GltfCornerTangents> tangents;
        forEachPrimitive(before, before, [&](std::size_t m, std::size_t p, const auto& corners, const auto&) {
            if (dice.below(3) == 0)
                return;
            std::vector<glm::vec4> made;
            for (std::size_t i = 0; i < corners.size(); ++i)
                made.emplace_back(dice.heads() ? 0.8f : -0.8f, 0, 0.6f, dice.heads() ? 1 : -1); // unit, as in glTF
            given[{m, p}] = made;
            tangents.push_back({m, p, made});
        });
        const auto set = cotan::setGltfTangents(*document, tangents);
        ASSERT_TRUE(set) << set.error().message;
        const Files after = writtenAs(folder, *document, "out.glb");
        expectSound(after);
        forEachPrimitive(before, after, [&](std::size_t m, std::size_t p, const auto& old, auto now) {
            const auto found = given.find({m, p});
            ASSERT_EQ(now.size(), old.size());
            for (std::size_t i = 0; i < now.size(); ++i) {
                if (found != given.end()) {
                    glm::vec4 tangent{0};
                    ASSERT_EQ(now[i]["TANGENT"].size(), sizeof tangent);
                    std::memcpy(&tangent, now[i]["TANGENT"].data(), sizeof tangent);
                    EXPECT_EQ(tangent, found->second[i]) << "seed " << seed;
                    now[i].erase("TANGENT");
                }
                EXPECT_EQ(now[i], old[i]) << "seed " << seed;
            }
        });
    }
}

// Triangles keep their order and winding, and vertex k is the first or the last corner of triangle k.
TEST(GltfEditRandom, provokingVerticesOnlyRotateTheCornersOfTriangles)
{
    for (std::uint32_t seed = 1; seed <= 40; ++seed)
        for (const bool last : {false, true}) {
            const TemporaryFolder folder;
            const Files before = Maker(seed).files();
            auto document = opened(folder, before);
            ASSERT_TRUE(document);
            const auto made =
                cotan::setGltfProvoking(*document, last ? cotan::ProvokingVertex::last : cotan::ProvokingVertex::first);
            ASSERT_TRUE(made);
            const Files after = writtenAs(folder, *document, "out.glb");
            expectSound(after);
            for (const auto& mesh : after.root["meshes"])
                for (const auto& primitive : mesh["primitives"]) {
                    const auto indices = read(after, primitive["indices"]);
                    for (std::size_t t = 0; t < indices.size() / 3; ++t) {
                        std::uint32_t index = 0;
                        const std::string& bytes = indices[3 * t + (last ? 2 : 0)];
                        std::memcpy(&index, bytes.data(), bytes.size());
                        EXPECT_EQ(index, t) << "seed " << seed;
                    }
                }
            forEachPrimitive(before, after, [&](std::size_t, std::size_t, const auto& old, const auto& now) {
                ASSERT_EQ(now.size(), old.size());
                for (std::size_t t = 0; t < old.size() / 3; ++t) {
                    const std::vector<Corner> was(old.begin() + long(3 * t), old.begin() + long(3 * t) + 3);
                    std::vector<Corner> is(now.begin() + long(3 * t), now.begin() + long(3 * t) + 3);
                    bool same = is == was;
                    for (int turns = 0; turns < 2 && !same; ++turns) {
                        std::rotate(is.begin(), is.begin() + 1, is.end());
                        same = is == was;
                    }
                    EXPECT_TRUE(same) << "seed " << seed << ", triangle " << t;
                }
            });
        }
}

} // namespace
