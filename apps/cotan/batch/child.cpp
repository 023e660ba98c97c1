#include "batch/child.hpp"

#include <algorithm>
#include <cstdlib>
#include <mutex>

#include "core/parse_number.hpp"
#include "files/file_registry.hpp"
#include "files/json.hpp"
#include "files/output.hpp"
#include "files/sandbox/request.hpp"
#include "image/format_table.hpp"
#include "model/model_formats.hpp"

namespace cotan::app {

namespace {

constexpr const char* kJobWord = "run-for-batch"; // first argument of a job process
constexpr std::size_t kFixedWords = 6;
constexpr const char *kAnswerName = "answer.json", *kThumbnailName = "thumbnail.png"; // in the work folder
constexpr std::size_t kMaxAnswerBytes = 256 << 20;
constexpr std::size_t kHead = 4096, kTail = 8192; // bytes of output kept, of the beginning and of the end

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
        if (modelFormatOf(file)) {
            const std::filesystem::path drawn = request.work / kThumbnailName;
            if (command({"render", file, "-o", drawn.string(), "--size", "128x128", "--samples", "1", "--quiet"}) == 0)
                return drawn;
            break;
        }
    return {};
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
    int thumbnails = 0;
    request.work = argv[2];
    parseNumber(argv[3], request.parent);
    parseNumber(argv[4], request.megabytes);
    parseNumber(argv[5], thumbnails);
    parseNumber(argv[6], request.processorSeconds);
    request.thumbnails = Thumbnails(thumbnails);
    request.words = {argv + kFixedWords + 1, argv + argc};
    limitJobProcess(request);
    std::set_new_handler([] { std::_Exit(kNoMemoryCode); });

    ChildAnswer answer;
    std::mutex mutex;
    const auto addTo = [&mutex](std::vector<std::string>& names) { // each name once, in order, from any thread
        return [&](const std::filesystem::path& file) {
            const std::lock_guard lock(mutex);
            if (std::ranges::find(names, file.string()) == names.end())
                names.push_back(file.string());
        };
    };
    watchInputs(addTo(answer.inputs));
    watchOutputs(addTo(answer.outputs));
    const int code = command(request.words);
    watchInputs({});
    watchOutputs({});
    Json j = {{"inputs", answer.inputs}, {"outputs", answer.outputs}};
    if (request.thumbnails != Thumbnails::none && (code == 0 || code == int(ErrorKind::limit)))
        if (const std::filesystem::path image = thumbnailSource(request, answer, command); !image.empty())
            if (const auto thumbnail = thumbnailOf(image))
                j["thumbnail"] = {
                    {"width", thumbnail->width}, {"height", thumbnail->height}, {"jpeg", thumbnail->jpeg}};
    const std::string text = j.dump(-1, ' ', false, Json::error_handler_t::replace);
    const Status written = writeFileWhole(request.work / kAnswerName, text);
    return written ? code : code != 0 ? code : int(ErrorKind::output);
}

void KeptOutput::add(std::string_view text)
{
    const std::size_t toHead = std::min(text.size(), kHead - head_.size());
    head_ += text.substr(0, toHead);
    tail_ += text.substr(toHead);
    if (tail_.size() > 2 * kTail) {
        tail_.erase(0, tail_.size() - kTail);
        cut_ = true;
    }
}

ChildAnswer readAnswer(const std::filesystem::path& work)
{
    const auto text = readText(work / kAnswerName, /*isInput*/ false, kMaxAnswerBytes);
    if (!text)
        return {};
    try {
        const auto j = Json::parse(*text);
        ChildAnswer answer{j.at("inputs"), j.at("outputs"), {}};
        if (const auto t = j.find("thumbnail"); t != j.end())
            answer.thumbnail = {t->at("width"), t->at("height"), t->at("jpeg")};
        return answer;
    } catch (const Json::exception&) {
        return {};
    }
}

} // namespace cotan::app
