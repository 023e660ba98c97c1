// The child process of the sandboxed reader.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <mutex>
#include <string_view>

#include <fmt/format.h>

#include "cotan/image.hpp"
#include "cotan/model.hpp"
#include "files/file_registry.hpp"
#include "files/sandbox/child.hpp"
#include "files/sandbox/confine.hpp"
#include "files/sandbox/request.hpp"
#include "files/sandbox/scene_wire.hpp"
#include "gltf/draco.hpp"

namespace cotan {

namespace {

class Reader {
public:
    explicit Reader(const ParentConnection& parent)
        : question_([parent](std::span<std::byte> bytes) { return parent.receive(bytes); }, std::uint64_t(8) << 30),
          answer_([parent](std::span<const std::byte> bytes) { return parent.send(bytes); })
    {
    }

    // Receives the request. Returns false if it is not valid.
    bool receiveRequest()
    {
        exchangeRequest(question_, request_);
        return question_.good() && request_.version == kReaderVersion;
    }

    void confineProcess()
    {
        dieWith(request_.parent);
        confine();
        setBudget();
        request_.limits.expect = [this](std::size_t bytes) { expect(bytes); };
        watchInputs([this](const std::filesystem::path& file) { reportInput(file); });
        std::set_new_handler([] { std::_Exit(kNoMemoryCode); });
    }

    void read()
    {
        if (request_.kind == ReaderKind::model)
            send(loadScene(request_.name, request_.limits), [&](const Scene& scene) { exchangeScene(answer_, scene); });
        else if (request_.kind == ReaderKind::image)
            send(decodeImage(request_.bytes, request_.name, request_.limits),
                 [&](const Image& image) { exchangeImage(answer_, image); });
        else if (request_.kind == ReaderKind::draco)
            readDraco();
        else
            readRows();
        answer_.flush();
    }

private:
    // Raises the memory and time limits before `bytes` bytes are decoded. Images may be decoded on several threads.
    void expect(std::size_t bytes)
    {
        const std::lock_guard lock(mutex_);
        decodedBytes_ += bytes;
        setBudget();
        answer_.choice(ReaderFrame::expect, ReaderFrame::error);
        answer_.number(std::uint64_t(bytes));
        answer_.flush();
    }

    // Reports a file that is read, so that the parent does not overwrite it.
    void reportInput(const std::filesystem::path& file)
    {
        const std::lock_guard lock(mutex_);
        answer_.choice(ReaderFrame::input, ReaderFrame::error);
        answer_.array(file.string());
        answer_.flush();
    }

    void setBudget() const
    {
        const LoadLimits& limits = request_.limits;
        ReaderBudget budget = budgetFor(limits, request_.fileBytes, decodedBytes_);
        budget.seconds = budgetFor(limits, request_.fileBytes, decodedBytes_ + rowBytes_).seconds;
        limitTo(budget, budgetFor(limits, SIZE_MAX, SIZE_MAX));
    }

    template<class T, class F> void send(const Result<T>& result, F exchangeValue)
    {
        answer_.choice(result ? ReaderFrame::value : ReaderFrame::error, ReaderFrame::error);
        if (result)
            exchangeValue(*result);
        else
            exchangeError(answer_, result.error());
        answer_.flush();
    }

    void readDraco()
    {
        std::vector<DracoJob> jobs;
        exchangeDracoJobs(question_, jobs);
        if (question_.good())
            send(decodeDracoHere(jobs),
                 [&](const std::vector<DracoGeometry>& meshes) { exchangeDracoGeometry(answer_, meshes); });
    }

    // Sends strips of the requested heights until the parent stops.
    void readRows()
    {
        const auto rows = openRows(request_.name, request_.limits);
        send(rows, [&](const std::unique_ptr<RowReader>& open) { exchangeRowFacts(answer_, *open); });
        std::int32_t height = 0;
        for (question_.number(height); rows && question_.good() && height > 0; question_.number(height)) {
            Image strip = makeImage((*rows)->width, height, (*rows)->type);
            rowBytes_ += strip.data.size();
            setBudget();
            send((*rows)->read(strip), [&](Done) { answer_.array(strip.data); });
        }
    }

    ReaderRequest request_;
    WireIn question_;
    WireOut answer_;
    std::mutex mutex_;
    std::size_t decodedBytes_ = 0, rowBytes_ = 0;
};

} // namespace

bool isReaderProcess(int argc, const char* const* argv)
{
    return argc == 2 && std::string_view(argv[1]) == kReaderWord;
}

int runReaderProcess()
{
    const auto parent = ParentConnection::take();
    if (!parent) {
        fmt::print(stderr, "{} is internal: it is started by another process, which sends requests on standard input\n",
                   kReaderWord);
        return 1;
    }
    Reader reader(*parent);
    if (!reader.receiveRequest())
        return 1;
    reader.confineProcess();
    reader.read();
    std::_Exit(0); // exits at once, since the parent waits: the system frees all memory
}

} // namespace cotan
