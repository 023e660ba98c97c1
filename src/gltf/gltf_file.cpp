#include "gltf_file.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <limits>
#include <optional>
#include <system_error>

#include "core/locale_of_c.hpp"
#include "core/one_line.hpp"
#include "files/bytes.hpp"
#include "files/file_registry.hpp"

namespace cotan {

namespace fs = std::filesystem;
using gltf::Json;

namespace {

std::uint32_t readWord(std::span<const std::byte> bytes, std::size_t at)
{
    std::uint32_t word = 0;
    for (std::size_t i = 0; i < 4; ++i)
        word |= std::to_integer<std::uint32_t>(bytes[at + i]) << (8 * i);
    return word;
}

void checkHeader(std::span<const std::byte> bytes)
{
    if (bytes.size() >= 8 && readWord(bytes, 4) == 1)
        failGltfVersion1("GLB header");
    if (bytes.size() < 20)
        failGltf("GLB header: expected at least 20 bytes, found {}", bytes.size());
    if (readWord(bytes, 4) != 2)
        failGltf("GLB header: expected version 2, found {}", readWord(bytes, 4));
    if (readWord(bytes, 8) != bytes.size())
        failGltf("GLB header: expected a file of {} bytes, found {}", readWord(bytes, 8), bytes.size());
}

// Walks the chunks and returns the JSON text. Unknown chunks are skipped, as the specification requires.
std::span<const std::byte> splitChunks(GltfFile& file, GltfWarnings& warnings)
{
    std::span<const std::byte> text;
    const std::span<const std::byte> bytes = file.bytes;
    checkHeader(bytes);
    std::size_t at = 12;
    for (int chunk = 0; at < bytes.size(); ++chunk) {
        const std::size_t left = bytes.size() - at;
        if (left < 8)
            failGltf("GLB chunk {}: expected a header of 8 bytes, found {} bytes", chunk, left);
        const std::size_t length = readWord(bytes, at);
        const std::uint32_t type = readWord(bytes, at + 4);
        if (length > left - 8)
            failGltf("GLB chunk {}: expected {} bytes, but only {} are left", chunk, length, left - 8);
        if (length % 4 != 0)
            warnings.add(fmt::format("GLB chunk {}", chunk), "its length is not a multiple of 4");
        if ((chunk == 0) != (type == kGlbJson))
            failGltf("GLB chunk {}: expected {}, found type 0x{:08x}", chunk,
                     chunk == 0 ? "JSON first" : "JSON only once", type);
        if (chunk == 0)
            text = bytes.subspan(at + 8, length);
        if (chunk == 1 && type == kGlbBinary)
            file.binary = bytes.subspan(at + 8, length);
        at += 8 + length;
    }
    return text;
}

// ---- JSON -----------------------------------------------------------------------------------

// Builds the document from parser events. The library's own builder searches all existing members of an object for each
// new member, so that an object of a million members would take hours.
class Builder : public nlohmann::json_sax<Json> {
public:
    explicit Builder(std::string_view text) : text_(text) {}

    Json root;

    bool null() override { return put(nullptr); }
    bool boolean(bool value) override { return put(value); }
    bool number_integer(number_integer_t value) override { return put(value); }
    bool number_unsigned(number_unsigned_t value) override { return put(value); }
    bool number_float(number_float_t value, const string_t&) override { return put(value); }
    bool string(string_t& value) override { return put(std::move(value)); }
    bool binary(binary_t&) override { return false; } // not in JSON
    bool start_object(std::size_t) override { return open(Json::object()); }
    bool start_array(std::size_t) override { return open(Json::array()); }
    bool end_object() override { return close(); }
    bool end_array() override { return close(); }

    bool key(string_t& name) override
    {
        isExtra_ = levels_.back().isExtra || name == "extras";
        member_ = &levels_.back().memberNamed(name);
        return true;
    }

    // position: of the last byte read, counted from 1. The parser's own messages are written for programmers.
    bool parse_error(std::size_t position, const std::string& last, const nlohmann::detail::exception& problem) override
    {
        const std::string_view before = text_.substr(0, std::min(std::max<std::size_t>(position, 1) - 1, text_.size()));
        const auto line = 1 + std::count(before.begin(), before.end(), '\n');
        const std::size_t column = before.size() - (before.find_last_of('\n') + 1) + 1; // npos + 1 is 0
        constexpr int kNumberTooLarge = 406;
        const bool ended = position > text_.size();
        failGltf("JSON: line {}, column {}: expected {}; found {}", line, column,
                 problem.id == kNumberTooLarge ? "a number in the range of double"
                     : ended                   ? "more"
                                               : "valid JSON",
                 ended ? "the end of the file" : quotedTail(last));
    }

private:
    struct Level {
        Json* value = nullptr;
        bool isExtra = false;                         // part of extras
        std::map<std::string, std::size_t> indices{}; // of the members; built once there are kFew

        // The member with this name; created if it is missing.
        Json& memberNamed(string_t& name)
        {
            constexpr std::size_t kFew = 16, kMaxMembers = 4096;
            auto& members = value->get_ref<Json::object_t&>();
            if (members.size() < kFew) {
                for (auto& [known, member] : members)
                    if (known == name)
                        return member;
            } else {
                if (indices.empty())
                    for (const auto& [known, member] : members)
                        indices.emplace(known, indices.size());
                if (const auto [known, isNew] = indices.emplace(name, members.size()); !isNew)
                    return (members.begin() + std::ptrdiff_t(known->second))->second;
            }
            if (members.size() >= kMaxMembers && !isExtra) // readers search members linearly
                failGltf("JSON: expected at most {} members in an object outside extras, found more", kMaxMembers);
            return members.emplace_back(std::move(name), nullptr).second;
        }
    };

    // The end of `read`, quoted on one line.
    static std::string quotedTail(std::string_view read)
    {
        constexpr std::size_t kMax = 24;
        std::string tail(read.substr(read.size() - std::min(read.size(), kMax)));
        for (char& c : tail)
            if (c < ' ' || c > '~')
                c = '?';
        return "'" + tail + "'";
    }

    // Stores the next value as the root, a member, or the end of an array, and returns it there.
    Json& put(Json&& value)
    {
        if (levels_.empty())
            return root = std::move(value);
        Json& owner = *levels_.back().value;
        if (owner.is_object())
            return *member_ = std::move(value);
        auto& items = owner.get_ref<Json::array_t&>();
        items.push_back(std::move(value));
        return items.back();
    }

    template<class T> bool put(T&& value)
    {
        put(Json(std::forward<T>(value)));
        return true;
    }

    bool open(Json&& value)
    {
        constexpr std::size_t kMaxDepth = 128; // code that walks the document recurses once per level
        if (levels_.size() >= kMaxDepth)
            failGltf("JSON: nested deeper than {} levels", kMaxDepth);
        levels_.push_back({&put(std::move(value)), isExtra_});
        return true;
    }

    bool close()
    {
        isExtra_ = levels_.back().isExtra;
        levels_.pop_back();
        return true;
    }

    std::string_view text_;
    std::vector<Level> levels_; // open objects and arrays
    Json* member_ = nullptr;    // the innermost object's member named last
    bool isExtra_ = false;      // whether the next value is part of extras
};

// ---- URIs -----------------------------------------------------------------------------------

// The value of each base64 digit; -1 for all other characters.
constexpr std::array<signed char, 256> kBase64 = [] {
    std::array<signed char, 256> values{};
    values.fill(-1);
    constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (std::size_t i = 0; i < digits.size(); ++i)
        values[static_cast<unsigned char>(digits[i])] = static_cast<signed char>(i);
    return values;
}();

// Decodes RFC 4648 base64; padding is optional. Nothing for any other character or an incomplete last group.
std::optional<std::vector<std::byte>> decodeBase64(std::string_view text)
{
    for (int i = 0; i < 2 && text.ends_with('='); ++i)
        text.remove_suffix(1);
    if (text.size() % 4 == 1)
        return std::nullopt;
    std::vector<std::byte> bytes;
    bytes.reserve(text.size() / 4 * 3 + 2);
    std::uint32_t bits = 0;
    int held = 0;
    for (const char c : text) {
        const int digit = kBase64[static_cast<unsigned char>(c)];
        if (digit < 0)
            return std::nullopt;
        bits = bits << 6 | std::uint32_t(digit);
        held += 6;
        if (held >= 8) {
            held -= 8;
            bytes.push_back(std::byte(bits >> held & 0xff));
        }
    }
    return bytes;
}

// Decodes "data:TYPE/SUBTYPE;base64,..." of RFC 2397. The media type may be missing and may have parameters, each of
// which needs a name.
std::vector<std::byte> decodeDataUri(std::string_view uri, const std::string& field)
{
    const std::size_t comma = uri.find(',');
    const std::string_view head = uri.substr(0, comma);
    if (comma == std::string_view::npos || !head.ends_with(";base64") || head.find(";;") != std::string_view::npos)
        failGltf("{}: expected data:TYPE;base64,... , found {}...", field, oneLine(uri.substr(0, 60)));
    auto bytes = decodeBase64(uri.substr(comma + 1));
    if (!bytes)
        failGltf("{}: the data URI is not valid base64", field);
    return std::move(*bytes);
}

std::span<const std::byte> bufferFile(GltfFile& file, const fs::path& path, const std::string& field,
                                      const LoadLimits& limits)
{
    auto known = file.bufferFiles.find(path);
    if (known == file.bufferFiles.end()) {
        Result<std::vector<std::byte>> bytes = readGltfResource(file, path, limits);
        if (!bytes)
            failGltf("{}: {}", field, bytes.error().message);
        file.size += bytes->size();
        known = file.bufferFiles.emplace(path, std::move(*bytes)).first;
    }
    return known->second;
}

} // namespace

std::string decodePercent(std::string_view uri)
{
    std::string text;
    for (std::size_t i = 0; i < uri.size(); ++i) {
        unsigned code = 0;
        const char* const digits = uri.data() + i + 1;
        const bool coded =
            uri[i] == '%' && i + 2 < uri.size() && std::from_chars(digits, digits + 2, code, 16).ptr == digits + 2;
        text += coded ? char(code) : uri[i];
        i += coded ? 2 : 0;
    }
    return text;
}

Json parseGltfJson(std::span<const std::byte> text)
{
    const auto* const first = reinterpret_cast<const char*>(text.data());
    Builder builder({first, text.size()});
    const LocaleOfC locale; // the parser calls strtod
    Json::sax_parse(first, first + text.size(), &builder);
    return std::move(builder.root);
}

Result<std::vector<std::byte>> readGltfResource(const GltfFile& file, const fs::path& resource,
                                                const LoadLimits& limits)
{
    if (!file.readFile)
        return readFileBytes(resource, limits.fileBytes);
    auto bytes = file.readFile(resource.string());
    if (bytes && bytes->size() > limits.fileBytes)
        return inputError(fmt::format("{}: the file has {} bytes, the limit is {}", resource.string(), bytes->size(),
                                      limits.fileBytes));
    return bytes;
}

void takeBytes(std::uint64_t& taken, std::uint64_t bytes, std::uint64_t limit, const char* what, std::size_t fileBytes,
               const std::string& field)
{
    limit = std::min<std::uint64_t>(limit, std::numeric_limits<std::size_t>::max());
    if (bytes > limit - std::min(taken, limit))
        failGltf("{}: {} {} bytes in total, the limit is {} for a file of {} bytes", field, what, taken + bytes, limit,
                 fileBytes);
    taken += bytes;
}

// Notes the files that a model names: no output replaces one that is not read, such as an image that stays as it is.
static void noteResources(const GltfFile& file)
{
    const auto note = [&](const std::string& uri) {
        std::error_code ignored;
        const fs::path named = uri.starts_with("data:") ? fs::path() : file.folder / decodePercent(uri);
        if (fs::is_regular_file(named, ignored))
            if (Status free = noteInput(named); !free)
                throw GltfProblem{free.error()};
    };
    for (const char* list : {"buffers", "images"})
        if (const auto entries = file.json.find(list); entries != file.json.end() && entries->is_array())
            for (const Json& entry : *entries)
                if (entry.is_object() && entry.contains("uri") && entry["uri"].is_string())
                    note(entry["uri"].get_ref<const std::string&>());
}

GltfFile readGltfFile(const fs::path& path, const LoadLimits& limits, GltfWarnings& warnings)
{
    GltfFile file;
    file.readFile = limits.readFile;
    auto bytes = readGltfResource(file, path, limits);
    if (!bytes)
        throw GltfProblem{inputError(bytes.error().message), /*namesFile*/ true};
    file.bytes = std::move(*bytes);
    file.modelBytes = file.size = file.bytes.size();
    if (!file.readFile)
        file.folder = fs::canonical(folderOf(path));
    file.isBinary = file.bytes.size() >= 4 && readWord(file.bytes, 0) == kGlbMagic;
    if (!file.isBinary && lowerExtension(path) == ".glb")
        failGltf("GLB header: expected the file to begin with \"glTF\"");
    file.json = parseGltfJson(file.isBinary ? splitChunks(file, warnings) : file.bytes);
    if (!file.readFile)
        noteResources(file);
    if (!file.isBinary)
        file.bytes = {}; // can be large if buffers are embedded as text
    return file;
}

GltfResource resolveGltfUri(const GltfFile& file, std::string_view uri, const std::string& field, bool mayMiss)
{
    if (uri.starts_with("data:"))
        return {{}, decodeDataUri(uri, field)};
    if (const std::size_t end = uri.find_first_of(":/?#"); end != uri.npos && uri[end] == ':') // a URI scheme
        failGltf("{}: expected a file in the model's folder, found \"{}\"", field, oneLine(uri));
    if (file.readFile)
        return {decodePercent(uri), {}};
    bool outside = false;
    const std::optional<fs::path> found = findInFolder(file.folder, decodePercent(uri), outside);
    if (outside)
        failGltf("{}: expected a file in the model's folder, found \"{}\", which leads out of it", field, oneLine(uri));
    if (!found && !mayMiss)
        failGltf("{}: there is no file \"{}\" in the model's folder", field, oneLine(uri));
    return {found.value_or(fs::path()), {}};
}

bool isGltfFallback(const gltf::Json& buffer)
{
    if (gltf::member(buffer, "uri"))
        return false;
    for (const char* const name : kMeshoptExtensions)
        if (const Json* const packed = gltf::extension(buffer, name))
            return gltf::valueOr(*packed, "fallback", false);
    return false;
}

void loadGltfBuffers(GltfFile& file, const LoadLimits& limits)
{
    const Json* const list = gltf::member(file.json, "buffers");
    const std::size_t count = list ? list->size() : 0;
    file.bufferBytes.reserve(count); // spans point into it
    for (std::size_t i = 0; i < count; ++i) {
        const std::string field = fmt::format("buffers[{}]", i);
        const gltf::Json& buffer = (*list)[i];
        if (isGltfFallback(buffer)) {
            file.buffers.emplace_back();
            continue;
        }
        const auto length = buffer["byteLength"].get<std::size_t>();
        std::span<const std::byte> bytes;
        if (const Json* const uri = gltf::member(buffer, "uri")) {
            GltfResource resource = resolveGltfUri(file, uri->get_ref<const std::string&>(), field + ".uri");
            if (resource.file.empty())
                bytes = file.bufferBytes.emplace_back(std::move(resource.bytes));
            else
                bytes = bufferFile(file, resource.file, field + ".uri", limits);
        } else if (i == 0 && file.isBinary) {
            bytes = file.binary;
        } else {
            failGltf("{}.uri: missing; only the first buffer of a GLB may omit it", field);
        }
        if (length > bytes.size())
            failGltf("{}.byteLength: expected {} bytes, found {}", field, length, bytes.size());
        file.buffers.push_back(bytes.first(length));
    }
}

std::span<const std::byte> gltfViewBytes(const GltfFile& file, const gltf::BufferView& view, const std::string& field)
{
    const std::span<const std::byte> bytes = file.buffers[view.buffer];
    if (view.offset > bytes.size() || view.length > bytes.size() - view.offset)
        failGltf("{}: it ends at byte {} of buffers[{}], which has {}", field, std::uint64_t(view.offset) + view.length,
                 view.buffer, bytes.size());
    return bytes.subspan(view.offset, view.length);
}

} // namespace cotan
