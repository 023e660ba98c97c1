#include "obj_text.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include <fmt/format.h>

#include "core/named_values.hpp"

namespace cotan {

namespace {

// How many numbers stand behind an option of a map at most, of which only the first has to be there; 0: one word.
constexpr Named<std::size_t> kMapOptions[] = {
    {"-blendu", 0}, {"-blendv", 0}, {"-cc", 0}, {"-clamp", 0}, {"-imfchan", 0}, {"-type", 0}, {"-colorspace", 0},
    {"-texres", 0}, {"-boost", 1},  {"-bm", 1}, {"-mm", 2},    {"-o", 3},       {"-s", 3},    {"-t", 3}};

constexpr Named<SourceMap SourceMaterial::*> kMaps[] = {
    {"map_kd", &SourceMaterial::colorMap},          {"map_ke", &SourceMaterial::emissionMap},
    {"map_emissive", &SourceMaterial::emissionMap}, {"map_d", &SourceMaterial::opacityMap},
    {"map_pr", &SourceMaterial::roughnessMap},      {"map_pm", &SourceMaterial::metalnessMap},
    {"norm", &SourceMaterial::normalMap},           {"map_kn", &SourceMaterial::normalMap}};

// u and v of the file, whose v runs up, are scaled and shifted; ours has v down.
void layOn(Texture& texture, glm::vec2 scale, glm::vec2 offset)
{
    texture.uRow = {scale.x, 0, offset.x};
    texture.vRow = {0, scale.y, 1 - scale.y - offset.y};
}

// Options, then a file name, which may hold spaces.
SourceMap readMap(Words words)
{
    SourceMap map;
    glm::vec2 scale(1), offset(0);
    for (std::string_view word = words.peek(); word.starts_with('-'); word = words.peek()) {
        const auto most = valueOf(kMapOptions, word);
        if (!most)
            break; // a file name that begins so
        words.next();
        std::array<float, 3> numbers{};
        std::size_t count = 0;
        while (count < *most)
            if (const auto number = finiteNumber(words.peek())) {
                numbers[count++] = *number;
                words.next();
            } else {
                break;
            }
        if (word == "-bm" && count == 1)
            map.strength = numbers[0];
        if (word == "-s" && count > 0)
            scale = {numbers[0], count > 1 ? numbers[1] : 1.0f};
        if (word == "-o" && count > 0)
            offset = {numbers[0], numbers[1]};
        if (*most == 0 && words.next() == "on" && word == "-clamp")
            map.use.sampler.wrapU = map.use.sampler.wrapV = Wrap::clamp;
    }
    layOn(map.use, scale, offset);
    map.path = words.all();
    return map;
}

// value: a float, or an optional one.
template<class Value> bool readNumber(Words words, Value& value)
{
    while (words.peek().starts_with("-halo"))
        words.next();
    const auto number = finiteNumber(words.next());
    if (number)
        value = *number;
    return number.has_value();
}

// A single number is a grey.
bool readColor(Words words, glm::vec3& value)
{
    glm::vec3 color;
    for (int c = 0; c < 3; ++c) {
        const std::string_view word = words.next();
        const auto number = c > 0 && word.empty() ? color[0] : finiteNumber(word);
        if (!number)
            return false;
        color[c] = std::max(*number, 0.0f);
    }
    value = color;
    return true;
}

// False: the numbers cannot be read.
bool readStatement(const std::string& keyword, Words words, SourceMaterial& m)
{
    if (keyword == "kd")
        return readColor(words, m.color);
    if (keyword == "ke")
        return readColor(words, m.emission);
    if (keyword == "ns")
        return readNumber(words, m.shininess);
    if (keyword == "d")
        return readNumber(words, m.opacity);
    if (keyword == "tr") {
        const bool good = readNumber(words, m.opacity);
        m.opacity = good ? 1 - m.opacity : m.opacity;
        return good;
    }
    if (keyword == "pr")
        return readNumber(words, m.roughness);
    if (keyword == "pm")
        return readNumber(words, m.metallic);
    if (const auto map = valueOf(kMaps, keyword))
        m.** map = readMap(words);
    return true;
}

} // namespace

MtlText parseMtl(std::string source)
{
    const TextLines lines(std::move(source));
    const std::string& text = lines.text();
    MtlText out;
    std::vector<SourceMap> bumps; // of each material: a map under "norm" goes before it
    std::size_t early = 0, broken = 0, brokenLine = 0;
    for (std::size_t offset = 0; offset < text.size();) {
        const std::size_t end = std::min(text.find('\n', offset), text.size());
        Words words{std::string_view(text).substr(offset, end - offset)};
        const std::string keyword = lowerCase(std::string(words.next()));
        const std::size_t begin = std::exchange(offset, end + 1);
        if (keyword.empty() || keyword.starts_with('#'))
            continue;
        if (keyword == "newmtl") {
            SourceMaterial& material = out.materials.emplace_back();
            material.name = words.all();
            material.color = glm::vec3(0.6f); // where there is no Kd
            bumps.emplace_back();
        } else if (out.materials.empty()) {
            ++early;
        } else if (keyword == "bump" || keyword == "map_bump") {
            bumps.back() = readMap(words);
        } else if (!readStatement(keyword, words, out.materials.back())) {
            brokenLine = broken++ == 0 ? lines.number(begin) : brokenLine;
        }
    }
    for (std::size_t i = 0; i < bumps.size(); ++i)
        if (out.materials[i].normalMap.path.empty())
            out.materials[i].normalMap = bumps[i];
    if (early > 0)
        out.warnings.push_back(fmt::format("{} lines before the first newmtl are left out", early));
    if (broken > 0)
        out.warnings.push_back(fmt::format("{} lines whose numbers cannot be read are left out, the first is line {}",
                                           broken, brokenLine));
    return out;
}

} // namespace cotan
