// Loads pages in headless Chromium with SwiftShader as its GPU.
#include "examples_browser.hpp"

namespace cotan::test {

using nlohmann::json;

void put(std::string& text, const std::string& word, const std::string& value)
{
    for (std::size_t at = 0; (at = text.find(word, at)) != std::string::npos; at += value.size())
        text.replace(at, word.size(), value);
}

json showPages(const TemporaryFolder& folder, const std::vector<std::string>& pages, int seconds)
{
    if (std::system("command -v chromium > /dev/null 2>&1") != 0)
        return "no chromium";
    std::string harness = readWhole(std::string(COTAN_SOURCE_DIR "/tests/examples_harness.html.in"));
    put(harness, "PAGES", json(pages).dump());
    write(folder / "all.html", harness);
    const std::string f = folder.path().string();
    // A WebGPU canvas needs textures that both processes share, which needs the Vulkan options.
    const std::string line = "timeout " + std::to_string(seconds)
        + " chromium --headless --no-sandbox --allow-file-access-from-files --user-data-dir='" + f
        + "/profile' --use-angle=swiftshader --enable-unsafe-swiftshader --enable-unsafe-webgpu "
          "--use-webgpu-adapter=swiftshader --enable-features=Vulkan --use-vulkan=swiftshader --disable-vulkan-surface "
          "--dump-dom 'file://"
        + f + "/all.html' > '" + f + "/dom' 2> '" + f + "/log'";
    const int code = std::system(line.c_str());
    const std::string dom = readWhole(folder / "dom");
    const std::size_t begin = dom.find("\">RESULT"), end = dom.find("END<", begin);
    if (begin == std::string::npos || end == std::string::npos)
        return {{"error", "chromium printed no result, exit " + std::to_string(code) + ": " + dom.substr(0, 80)}};
    return json::parse(dom.substr(begin + 8, end - begin - 8));
}

} // namespace cotan::test
