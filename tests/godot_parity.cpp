// Draws a case as an unshaded material: the image has a column for each sample, whose numbers are bytes of a texture.
#include "godot_parity.hpp"

#include "godot_draw.hpp"

namespace cotan::test {

namespace {

constexpr char kInputs[] = R"(
uniform sampler2D inputs;
uniform float part;
float cotan_test_input(float row, float k)
{
    vec4 b = floor(texture(inputs, vec2((k + 0.5) / 16.0, (row + 0.5) / ROWS)) * 255.0 + vec4(0.5));
    float negative = b.w >= 128.0 ? 1.0 : 0.0;
    float low = b.z >= 128.0 ? 1.0 : 0.0;
    float exponent = (b.w - 128.0 * negative) * 2.0 + low;
    float mantissa = 1.0 + ((b.z - 128.0 * low) * 65536.0 + b.y * 256.0 + b.x) / 8388608.0;
    float size = exponent > 0.0 ? mantissa * exp2(exponent - 127.0) : 0.0;
    return negative > 0.0 ? -size : size;
}
vec3 cotan_test_three(float row, float k)
{
    return vec3(cotan_test_input(row, k), cotan_test_input(row, k + 1.0), cotan_test_input(row, k + 2.0));
}
vec2 cotan_test_two(float row, float k)
{
    return vec2(cotan_test_input(row, k), cotan_test_input(row, k + 1.0));
}
)";

std::string shaderOf(const Case& c, std::size_t samples)
{
    std::string inputs = kInputs;
    inputs.replace(inputs.find("ROWS"), 4, std::to_string(samples) + ".0");
    return "shader_type spatial;\nrender_mode unshaded, cull_disabled;\n" + inputs + kGodotNumbers
        + c.text(shader_text::Language::godot)
        + "void fragment()\n{\n"
          "    float row = floor(FRAGCOORD.x);\n"
          "    vec3 n = cotan_test_three(row, 0.0);\n"
          "    vec3 dpdx = cotan_test_three(row, 3.0);\n"
          "    vec3 dpdy = cotan_test_three(row, 6.0);\n"
          "    vec2 duvdx = cotan_test_two(row, 9.0);\n"
          "    vec2 duvdy = cotan_test_two(row, 11.0);\n"
          "    vec3 m = cotan_test_three(row, 13.0);\n"
          "    vec3 r = "
        + c.call
        + ";\n    float value = part < 1.5 ? r.x : (part < 3.5 ? r.y : r.z);\n"
          "    ALBEDO = cotan_test_float(value, mod(part, 2.0) > 0.5);\n}\n";
}

} // namespace

Results runGodotCases(const std::vector<Case>& cases, const std::vector<Sample>& samples, const std::string& driver)
{
    Results results{"godot " + driver, {}, {}};
    std::string bytes;
    for (const Sample& s : samples)
        bytes.append(reinterpret_cast<const char*>(&s.v), sizeof s.v);
    GodotJobs jobs;
    const int count = static_cast<int>(samples.size());
    const nlohmann::json inputs = jobs.texture(bytes, 16, count);
    for (const Case& c : cases)
        jobs.add(shaderOf(c, samples.size()), count, 2, 6, {{"textures", {{"inputs", inputs}}}});
    const std::size_t part = samples.size() * 2 * 3;
    for (const std::string& image : jobs.draw(driver)) {
        results.values.emplace_back();
        for (std::size_t s = 0; s < samples.size(); ++s) {
            glm::dvec3 value;
            for (int k = 0; k < 3; ++k) {
                const char* at = image.data() + 3 * s + 2 * part * static_cast<std::size_t>(k);
                value[k] = floatOfBytes(at, at + part);
            }
            results.values.back().push_back(value);
        }
    }
    return results;
}

} // namespace cotan::test
