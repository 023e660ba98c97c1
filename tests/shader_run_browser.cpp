// Runs ESSL by WebGL 2 and WGSL by WebGPU, both in headless Chromium with its software drivers.
#include <nlohmann/json.hpp>

#include "shader_run.hpp"

namespace cotan::test {

namespace {

using nlohmann::json;
using shader_text::Language;

constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

std::string toBase64(const std::string& bytes)
{
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t v = 0;
        for (std::size_t k = 0; k < 3; ++k)
            v = v << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
        for (std::size_t k = 0; k < 4; ++k)
            text += i + k <= bytes.size() ? kDigits[v >> (18 - 6 * k) & 63] : '=';
    }
    return text;
}

std::string fromBase64(const std::string& text)
{
    std::string bytes;
    std::uint32_t v = 0;
    int bits = 0;
    for (char c : text) {
        const std::string_view digits(kDigits, 64);
        const std::size_t digit = digits.find(c);
        if (digit == std::string_view::npos)
            break;
        v = v << 6 | static_cast<std::uint32_t>(digit);
        bits += 6;
        if (bits >= 8) {
            bits -= 8;
            bytes += static_cast<char>(v >> bits & 255);
        }
    }
    return bytes;
}

// Fragment shaders with every set of functions, which are only compiled.
json fragmentOf(const FrameInfo& f)
{
    shader_text::Choice choice;
    choice.frame = f.frame;
    choice.sets = {std::begin(shader_text::kSets), std::end(shader_text::kSets)};
    choice.language = Language::essl;
    const std::string essl = makeShaderText(choice)->text
        + "in vec3 n, p, t; in vec2 uv; out vec4 o;\nvoid main() { o = vec4(cotan_perturb_normal(n, p, uv, t), 1.0); "
          "}\n";
    choice.language = Language::wgsl;
    const std::string wgsl = makeShaderText(choice)->text
        + "@fragment fn main(@location(0) n: vec3f, @location(1) p: vec3f, @location(2) t: vec3f, @location(3) uv: "
          "vec2f)"
          " -> @location(0) vec4f { return vec4f(cotan_perturb_normal(n, p, uv, t), 1.0); }\n";
    return {{"name", f.name}, {"essl", essl}, {"wgsl", wgsl}};
}

// key: name of the list in `found`. count: number of 3-vectors of a case.
Results resultsOf(const std::string& label, const json& found, const char* key, std::size_t count)
{
    Results results{label, {}, {}};
    if (found.contains("error"))
        throw std::runtime_error(label + ": " + found["error"].get<std::string>());
    if (found.contains("skipped")) {
        results.skipped = found["skipped"];
        return results;
    }
    for (const json& text : found[key])
        results.values.push_back(valuesOf<float>(fromBase64(text), 1, count).at(0));
    return results;
}

} // namespace

BrowserResults runBrowser(const std::vector<Case>& cases, const std::vector<Sample>& samples,
                          const std::vector<Case>& drawn, const std::vector<Corner>& corners)
{
    const auto nothing = [](const std::string& why) {
        const Results essl{"essl", why, {}}, wgsl{"wgsl", why, {}};
        return BrowserResults{essl, wgsl, essl, wgsl};
    };
    TemporaryFolder folder;
    const std::string f = folder.path().string();
    if (!shell("command -v chromium", folder / "log"))
        return nothing("no chromium");
    writeItems(folder / "in", vectorsOf(samples));
    writeItems(folder / "corners", corners);
    json work{{"input", toBase64(readWhole(folder / "in"))},
              {"corners", toBase64(readWhole(folder / "corners"))},
              {"target", kTarget},
              {"cases", json::array()},
              {"drawn", json::array()},
              {"fragments", json::array()}};
    for (const auto& [key, list] : {std::pair("cases", &cases), {"drawn", &drawn}})
        for (const Case& c : *list)
            work[key].push_back({{"name", c.name},
                                 {"call", c.call},
                                 {"essl", c.text(Language::essl)},
                                 {"wgsl", c.text(Language::wgsl)}});
    for (const FrameInfo& frame : frames())
        if (frame.source == FrameSource::differences)
            work["fragments"].push_back(fragmentOf(frame));
    std::string page = readWhole(COTAN_SOURCE_DIR "/tests/shader_browser.html.in");
    page.replace(page.find("WORK"), 4, work.dump());
    writeText(folder / "page.html", page);
    shell("timeout 200 chromium --headless --no-sandbox --user-data-dir='" + f
              + "/profile' --use-angle=swiftshader"
                " --enable-unsafe-swiftshader --enable-unsafe-webgpu --use-webgpu-adapter=swiftshader"
                " --dump-dom 'file://"
              + f + "/page.html' > '" + f + "/dom'",
          folder / "log");
    const std::string dom = readWhole(folder / "dom");
    const std::size_t begin = dom.find("\">RESULT"), end = dom.find("END<", begin);
    if (begin == std::string::npos || end == std::string::npos)
        return nothing("chromium printed no result: " + dom.substr(0, 80));
    std::string text = dom.substr(begin + 8, end - begin - 8);
    for (const auto& [from, to] : {std::pair<std::string, std::string>("&lt;", "<"), {"&gt;", ">"}, {"&amp;", "&"}})
        for (std::size_t at; (at = text.find(from)) != std::string::npos;)
            text.replace(at, from.size(), to);
    const json found = json::parse(text);
    const std::size_t pixels = 2 * kTarget * kTarget;
    return {resultsOf("essl", found["essl"], "results", samples.size()),
            resultsOf("wgsl", found["wgsl"], "results", samples.size()),
            resultsOf("essl", found["essl"], "pixels", pixels), resultsOf("wgsl", found["wgsl"], "pixels", pixels)};
}

} // namespace cotan::test
