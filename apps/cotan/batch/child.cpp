#include "batch/child.hpp"

#include <algorithm>
#include <charconv>
#include <csignal>
#include <mutex>
#include <new>

#include <nlohmann/json.hpp>
#include <sys/resource.h>
#include <unistd.h>

#include "files/bytes.hpp"
#include "files/file_registry.hpp"
#include "files/output.hpp"
#include "files/sandbox/confine.hpp"
#include "image/format_table.hpp"
#include "thumbnail.hpp"

namespace cotan {

namespace {

using nlohmann::ordered_json;

constexpr const char* kJobWord = "run-for-batch"; // first argument of a job process
constexpr std::size_t kFixedWords = 6;
constexpr std::size_t kMaxAnswerBytes = 256 << 20;

// Collects file names without duplicates, in order; thread-safe.
class Names {
public:
    void add(const std::filesystem::path& file)
    {
        const std::lock_guard lock(mutex_);
        if (open_ && std::ranges::find(all_, file.string()) == all_.end())
            all_.push_back(file.string());
    }
    std::vector<std::string> close()
    {
        const std::lock_guard lock(mutex_);
        open_ = false;
        return all_;
    }

private:
    std::mutex mutex_;
    std::vector<std::string> all_;
    bool open_ = true;
};

bool hasExtension(const std::string& file, std::initializer_list<const char*> known)
{
    const std::string extension = lowerExtension(file);
    return std::ranges::any_of(known, [&](const char* one) { return extension == one; });
}

// An image to make the thumbnail from; empty: none.
std::filesystem::path thumbnailSource(const ChildRequest& request, const ChildAnswer& answer,
                                      const std::function<int(const std::vector<std::string>&)>& command)
{
    for (const std::string& file : answer.outputs)
        if (imageFormatHas(file, &ImageFormat::reads))
            return file;
    if (request.thumbnails != Thumbnails::models)
        return {};
    for (const std::string& file : answer.inputs)
        if (hasExtension(file, {".glb", ".gltf", ".obj", ".ply", ".stl", ".dae", ".fbx", ".3ds"})) {
            const std::filesystem::path drawn = request.work / kThumbnailName;
            if (command({"render", file, "-o", drawn.string(), "--size", "128x128", "--samples", "1", "--quiet"}) == 0)
                return drawn;
            break;
        }
    return {};
}

std::size_t numberIn(const char* text)
{
    std::size_t value = 0;
    std::from_chars(text, text + std::string_view(text).size(), value);
    return value;
}

} // namespace

std::vector<std::string> toWords(const ChildRequest& request)
{
    std::vector<std::string> words = {kJobWord,
                                      request.work.string(),
                                      std::to_string(request.parent),
                                      std::to_string(request.megabytes),
                                      std::to_string(int(request.thumbnails)),
                                      std::to_string(request.processorSeconds)};
    words.insert(words.end(), request.words.begin(), request.words.end());
    return words;
}

bool isJobProcess(int argc, const char* const* argv)
{
    return argc > int(kFixedWords) && std::string_view(argv[1]) == kJobWord;
}

int runJobProcess(int argc, const char* const* argv, const std::function<int(const std::vector<std::string>&)>& command)
{
    ChildRequest request;
    request.work = argv[2];
    request.parent = std::int64_t(numberIn(argv[3]));
    request.megabytes = numberIn(argv[4]);
    request.thumbnails = Thumbnails(numberIn(argv[5]));
    request.processorSeconds = numberIn(argv[6]);
    request.words = {argv + kFixedWords + 1, argv + argc};
    dieWith(request.parent, SIGTERM); // the handler of SIGTERM removes unfinished files
    leaveNoCore();
    if (!kSanitized && request.megabytes > 0)
        setLimit(RLIMIT_DATA, request.megabytes << 20, request.megabytes << 20);
    if (request.processorSeconds > 0)
        setLimit(RLIMIT_CPU, request.processorSeconds, RLIM_INFINITY);
    std::set_new_handler([] { ::_exit(kNoMemoryCode); });

    Names inputs, outputs;
    watchInputs([&](const std::filesystem::path& file) { inputs.add(file); });
    watchOutputs([&](const std::filesystem::path& file) { outputs.add(file); });
    const int code = command(request.words);
    ChildAnswer answer{inputs.close(), outputs.close(), {}};
    ordered_json j = {{"inputs", answer.inputs}, {"outputs", answer.outputs}};
    if (request.thumbnails != Thumbnails::none && (code == 0 || code == int(ErrorKind::limit)))
        if (const std::filesystem::path image = thumbnailSource(request, answer, command); !image.empty())
            if (const auto thumbnail = thumbnailOf(image))
                j["thumbnail"] = {
                    {"width", thumbnail->width}, {"height", thumbnail->height}, {"jpeg", thumbnail->jpeg}};
    watchInputs({});
    watchOutputs({});
    const std::string text = j.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
    const Status written = writeFileWhole(request.work / kAnswerName, text);
    return written ? code : code != 0 ? code : int(ErrorKind::output);
}

ChildAnswer readAnswer(const std::filesystem::path& work)
{
    ChildAnswer answer;
    const auto bytes = readFileBytes(work / kAnswerName, kMaxAnswerBytes, /*isInput*/ false);
    if (!bytes)
        return answer;
    try {
        const auto j =
            nlohmann::json::parse(std::string_view(reinterpret_cast<const char*>(bytes->data()), bytes->size()));
        answer.inputs = j.at("inputs");
        answer.outputs = j.at("outputs");
        if (j.contains("thumbnail")) {
            const auto& t = j["thumbnail"];
            answer.thumbnail = {t.at("width"), t.at("height"), t.at("jpeg")};
        }
    } catch (const nlohmann::json::exception&) {
        return {};
    }
    return answer;
}

} // namespace cotan
