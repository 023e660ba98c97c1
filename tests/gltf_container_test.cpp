// How a glTF file is parsed before its contents are examined: chunks, JSON, URIs and buffers, with the numbers in
// messages. Sources: glTF 2.0, sections 3.6.1 and 4.4; RFC 3986, 2.1; RFC 4648.
#include <tuple>

#include "gltf_maker.hpp"

namespace {

using namespace cotan::test;
using cotan::LoadLimits;

// The error message after the file name; "" if the file is read.
std::string complaint(const cotan::Result<cotan::Scene>& scene)
{
    if (scene)
        return "";
    const std::string& message = scene.error().message;
    const std::size_t name = message.find("/model.");
    return message.substr(message.find(": ", name) + 2);
}

std::string chunkOf(const std::string& type, const std::string& content)
{
    return word(std::uint32_t(content.size())) + type + content;
}

std::string container(const std::string& chunks, std::uint32_t version = 2, std::uint32_t more = 0)
{
    return "glTF" + word(version) + word(std::uint32_t(12 + chunks.size()) + more) + chunks;
}

const std::string kBin("BIN\0", 4), kOther("ABCD");

// The square's JSON with its buffer in a chunk, padded to a multiple of four bytes.
std::string plainJson(const Gltf& g)
{
    json root = g.root;
    root["buffers"] = {{{"byteLength", g.bytes.size()}}};
    std::string text = root.dump();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    return text;
}

TEST(GltfContainer, headerAndChunkLengthsAreChecked)
{
    const Gltf g = square();
    const std::string text = chunkOf("JSON", plainJson(g)), bin = chunkOf(kBin, g.bytes);
    const std::string length = std::to_string(text.size() - 8), data = std::to_string(g.bytes.size());
    const std::pair<std::string, std::string> cases[] = {
        {container(text + bin), ""},
        {container(text + bin + chunkOf(kOther, "1234")), ""},
        {container(text + bin).substr(0, 7), "GLB header: expected at least 20 bytes, found 7"},
        {container(std::string(7, ' ')), "GLB header: expected at least 20 bytes, found 19"},
        {container(text, 3), "GLB header: expected version 2, found 3"},
        {container(text, 0), "GLB header: expected version 2, found 0"},
        {container(chunkOf("JSON", ""), 2, 1), "GLB header: expected a file of 21 bytes, found 20"},
        {container(text + bin.substr(0, 7)), "GLB chunk 1: expected a header of 8 bytes, found 7 bytes"},
        {container(text.substr(0, text.size() - 1)),
         "GLB chunk 0: expected " + length + " bytes, but only " + std::to_string(text.size() - 9) + " are left"},
        {container(text + bin.substr(0, bin.size() - 1)),
         "GLB chunk 1: expected " + data + " bytes, but only " + std::to_string(g.bytes.size() - 1) + " are left"},
        {container(bin + text), "GLB chunk 0: expected JSON first, found type 0x004e4942"},
        {container(text + bin + text), "GLB chunk 2: expected JSON only once, found type 0x4e4f534a"},
        // The binary chunk is the second one, or there is none.
        {container(text + chunkOf(kOther, "1234") + bin),
         "buffers[0].byteLength: expected " + data + " bytes, found 0"},
        {container(text), "buffers[0].byteLength: expected " + data + " bytes, found 0"},
    };
    for (const auto& [bytes, message] : cases)
        EXPECT_EQ(complaint(loadText(bytes, "model.glb")), message);
    COTAN_LOADED(odd, loadText(container(text + bin + chunkOf(kOther, "12345")), "model.glb"));
    EXPECT_EQ(odd.warnings, std::vector<std::string>{"GLB chunk 2: its length is not a multiple of 4"});
    EXPECT_EQ(odd.name, "model");
}

TEST(GltfContainer, aBufferHasAUriUnlessItIsTheFirstOfAGlb)
{
    Gltf g = square();
    json root = g.root;
    root["buffers"] = {{{"byteLength", g.bytes.size()}}, {{"byteLength", 4}}};
    const std::string missing = ".uri: missing; only the first buffer of a GLB may omit it";
    EXPECT_EQ(complaint(loadText(container(chunkOf("JSON", root.dump()) + chunkOf(kBin, g.bytes)), "model.glb")),
              "buffers[1]" + missing);
    EXPECT_EQ(complaint(loadText(root.dump())), "buffers[0]" + missing);
}

TEST(GltfContainer, invalidJsonIsReportedByLineAndColumn)
{
    // The message ends with the text at that position: the end of what the parser read, if it is long.
    const std::tuple<std::string, std::string, std::string> cases[] = {
        {"{\"a\":}", "line 1, column 6: expected valid JSON; found '", "}'"},
        {"{\n \"a\": x}", "line 2, column 7: expected valid JSON; found '", "x'"},
        {"\n\n\n  ]", "line 4, column 3: expected valid JSON; found '", "]'"},
        {"{\"a\": 1", "line 1, column 8: expected more; found ", "the end of the file"},
        {"{\"a\":\n[", "line 2, column 2: expected more; found ", "the end of the file"},
        {"{\"a\": 1e999}", "line 1, column 11: expected a number in the range of double; found '", "1e999'"},
        // Of long texts the last 24 characters, without any that a terminal would interpret.
        {"[123456789012345678901234567890x", "line 1, column 32: expected valid JSON; found '",
         "89012345678901234567890x'"},
        {"[\"0123456789012345678901234567890\xff\"", "line 1, column 34: expected valid JSON; found '",
         "89012345678901234567890?'"},
    };
    for (const auto& [text, message, end] : cases) {
        const std::string found = complaint(loadText(text));
        EXPECT_TRUE(found.starts_with("JSON: " + message)) << found;
        EXPECT_TRUE(found.ends_with(end)) << found;
        EXPECT_LE(found.size(), 6 + message.size() + 24 + 1) << found;
    }
}

TEST(GltfContainer, jsonMayBeNested128LevelsDeep)
{
    for (const int arrays : {127, 128}) { // inside the object that is the document
        std::string text = square().text();
        text.insert(
            1, "\"extras\":" + std::string(std::size_t(arrays), '[') + std::string(std::size_t(arrays), ']') + ",");
        EXPECT_EQ(complaint(loadText(text)), arrays == 127 ? "" : "JSON: nested deeper than 128 levels");
    }
}

// A percent sign that starts no code stands for itself, and a scheme must precede the first / ? or #.
TEST(GltfContainer, urisNameFilesPlainOrPercentEncoded)
{
    const TemporaryFolder folder;
    Gltf g = square();
    const std::string bytes = g.bytes;
    g.bytes.clear();
    const auto message = [&](const std::string& uri) {
        g.root["buffers"] = {{{"byteLength", bytes.size()}, {"uri", uri}}};
        return complaint(cotan::loadGltf(folder.write("model.gltf", g.text())));
    };
    const std::pair<const char*, const char*> names[] = {
        {"a%zz.bin", "a%zz.bin"},       {"b%4", "b%4"},     {"c%", "c%"},
        {"d%4g.bin", "d%4g.bin"},       {"%41", "A"},       {"e%2", "e%2"},
        {"50%25.bin", "50%.bin"},       {"pn%67", "png"},   {"%7e%7E", "~~"},
        {"sub/f:g.bin", "sub/f:g.bin"}, {"h#i:j", "h#i:j"}, {"k?l:m", "k?l:m"},
    };
    for (const auto& [uri, name] : names) {
        folder.write(name, bytes);
        EXPECT_EQ(message(uri), "") << uri;
    }
    folder.write("n:o", bytes);
    EXPECT_EQ(message("n:o"), "buffers[0].uri: expected a file in the model's folder, found \"n:o\"");
    EXPECT_EQ(message("../p"),
              "buffers[0].uri: expected a file in the model's folder, found \"../p\", which leads out of it");
    EXPECT_EQ(message("%41%42"), "buffers[0].uri: there is no file \"%41%42\" in the model's folder");
}

TEST(GltfContainer, dataUrisAreBase64OfAnyLengthPaddedOrNot)
{
    const auto message = [](const std::string& uri, std::size_t length) {
        const json root = {{"asset", {{"version", "2.0"}}}, {"buffers", {{{"byteLength", length}, {"uri", uri}}}}};
        return complaint(loadText(root.dump()));
    };
    const std::string head = "data:application/octet-stream;base64,";
    for (const auto& [text, bytes] : {std::pair{"", 0},
                                      {"AA==", 1},
                                      {"AA", 1},
                                      {"AAA=", 2},
                                      {"AAA", 2},
                                      {"AAAA", 3},
                                      {"AAAAAA==", 4},
                                      {"AAAAAAA", 5},
                                      {"AAAAAAAA", 6}}) {
        EXPECT_EQ(message(head + text, std::size_t(bytes)), "") << text;
        EXPECT_EQ(message(head + text, std::size_t(bytes) + 1),
                  "buffers[0].byteLength: expected " + std::to_string(bytes + 1) + " bytes, found "
                      + std::to_string(bytes));
    }
    for (const char* text : {"A", "AAAAA", "A===", "AA=A", "A A=", "AA-_", "AAA\u00e9"})
        EXPECT_EQ(message(head + text, 0), "buffers[0].uri: the data URI is not valid base64") << text;
    const std::string expected = "buffers[0].uri: expected data:TYPE;base64,... , found ";
    EXPECT_EQ(message("data:,AAAA", 0), expected + "data:,AAAA...");
    EXPECT_EQ(message("data:a/b;;base64,AAAA", 0), expected + "data:a/b;;base64,AAAA...");
    const std::string longest = "data:" + std::string(100, 'x');
    EXPECT_EQ(message(longest, 0), expected + longest.substr(0, 60) + "...");
    EXPECT_EQ(message("data:;base64,AAAA", 3), "");
    EXPECT_EQ(message("data:a/b;c=d;base64,AAAA", 3), "");
}

// Views must end within their buffer, even empty ones.
TEST(GltfContainer, viewsMustEndWithinTheirBuffer)
{
    Gltf g = square();
    const std::size_t all = g.bytes.size();
    ASSERT_EQ(g.root["bufferViews"][3]["byteOffset"], all - 12);
    const std::string has = " of buffers[0], which has " + std::to_string(all);
    EXPECT_EQ(complaint(g.load()), "");
    g.root["bufferViews"][3]["byteLength"] = 13;
    EXPECT_EQ(complaint(g.load()), "bufferViews[3]: it ends at byte " + std::to_string(all + 1) + has);
    g.root["bufferViews"][3]["byteLength"] = 0;
    g.root["bufferViews"][3]["byteOffset"] = all + 1;
    EXPECT_EQ(complaint(g.load()), "bufferViews[3]: it ends at byte " + std::to_string(all + 1) + has);
}

// A buffer file is read once however many buffers it contains. It is subject to the limit of file sizes, and its size
// counts towards the model's when geometry is limited relative to the model's size.
TEST(GltfContainer, bufferFilesAreReadOnceAndCountAsInputs)
{
    Gltf g = square();
    const std::size_t used = g.bytes.size();
    json root = g.root;
    root["buffers"] = {{{"byteLength", used}, {"uri", "data%20file.bin"}},
                       {{"byteLength", 9}, {"uri", "data%20file.bin"}}};
    const std::string text = root.dump(), data = g.bytes + std::string(text.size(), 'x'); // longer than the JSON
    std::vector<std::string> requested;
    LoadLimits limits;
    const auto asBytes = [](const std::string& s) {
        const auto* const first = reinterpret_cast<const std::byte*>(s.data());
        return cotan::Result<std::vector<std::byte>>(std::vector<std::byte>(first, first + s.size()));
    };
    const auto loaded = [&](const std::string& model) {
        requested.clear();
        limits.readFile = [&](const std::string& name) {
            requested.push_back(name);
            return asBytes(requested.size() == 1 ? model : data);
        };
        return cotan::loadGltf("folder/model.gltf", limits);
    };
    EXPECT_EQ(complaint(loaded(text)), "");
    EXPECT_EQ(requested, (std::vector<std::string>{"folder/model.gltf", "data file.bin"}));
    limits.fileBytes = data.size();
    EXPECT_EQ(complaint(loaded(text)), "");
    limits.fileBytes = data.size() - 1;
    const std::string tooLong = " bytes, the limit is ";
    EXPECT_EQ(complaint(loaded(text)),
              "buffers[0].uri: data file.bin: the file has " + std::to_string(data.size()) + tooLong
                  + std::to_string(data.size() - 1));
    limits.fileBytes = text.size() - 1;
    EXPECT_EQ(complaint(loaded(text)),
              "the file has " + std::to_string(text.size()) + tooLong + std::to_string(text.size() - 1));
    limits = {};
    limits.geometryBytes = 1000;
    root["accessors"].push_back({{"componentType", kFloat}, {"type", "VEC3"}, {"count", 5'000'000}});
    const std::string large = root.dump();
    const std::size_t size = large.size() + data.size(), before = 48 + 48 + 32 + 12; // the square's accessors
    EXPECT_EQ(complaint(loaded(large)),
              "accessors[4]: the accessors take " + std::to_string(before + 60'000'000)
                  + " bytes in total, the limit is " + std::to_string(1000 + 16 * size) + " for a file of "
                  + std::to_string(size) + " bytes");
}

// A hundred kinds are listed, and then the number of others; kinds already listed continue to be counted.
TEST(GltfWarnings, atMostAHundredKindsAreListed)
{
    for (const int kinds : {100, 101, 103}) {
        Gltf g = square();
        const json p = primitive(g);
        for (int i = 0; i < kinds + 1; ++i) { // the last repeats the first
            g.root["materials"][std::size_t(i)] = {{"extras", {{"cotanFrame", "f" + std::to_string(i % kinds)}}}};
            json next = p;
            next["material"] = i;
            g.root["meshes"][0]["primitives"][std::size_t(i)] = next;
        }
        COTAN_LOADED(scene, g.load());
        ASSERT_EQ(scene.warnings.size(), kinds == 100 ? 100u : 101u);
        EXPECT_EQ(scene.warnings[0],
                  "materials[0].extras.cotanFrame and 1 more: expected the name of a frame, found 'f0'; ignored");
        EXPECT_EQ(scene.warnings[99],
                  "materials[99].extras.cotanFrame: expected the name of a frame, found 'f99'; ignored");
        if (kinds > 100) {
            EXPECT_EQ(scene.warnings[100], std::to_string(kinds - 100) + " more warnings are left out");
        }
    }
}

// Text from a file is put on one line and cut after 500 bytes.
TEST(GltfWarnings, quotedTextIsOneLineOfBoundedLength)
{
    const auto warningOf = [](const std::string& frame) {
        Gltf g = square();
        g.root["materials"][0]["extras"]["cotanFrame"] = frame;
        const auto scene = g.load();
        return scene && !scene->warnings.empty() ? scene->warnings[0] : "";
    };
    const std::string before = "materials[0].extras.cotanFrame: expected the name of a frame, found '",
                      after = "'; ignored";
    EXPECT_EQ(warningOf("a\nb\tc\x7f\x1f"
                        "d e \n"),
              before + "a b c  d e" + after);
    const std::string filler(500 - before.size() - after.size(), 'x');
    EXPECT_EQ(warningOf(filler), before + filler + after);
    EXPECT_EQ(warningOf(filler + "x"), (before + filler + "x" + after).substr(0, 500) + "...");
}

} // namespace
