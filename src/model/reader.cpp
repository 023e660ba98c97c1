// What the child of a sandboxed reader does.
#include <algorithm>
#include <cstdio>
#include <mutex>
#include <string_view>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include "cotan/image.hpp"
#include "cotan/model.hpp"
#include "files/file_registry.hpp"
#include "files/sandbox/confine.hpp"
#include "files/sandbox/request.hpp"
#include "files/sandbox/scene_wire.hpp"
#include "gltf/draco.hpp"

namespace cotan {

namespace {

class Reader {
public:
    explicit Reader(int socket)
        : question_(
            [socket](std::span<std::byte> bytes) {
                return std::size_t(std::max<ssize_t>(::recv(socket, bytes.data(), bytes.size(), 0), 0));
            },
            std::uint64_t(8) << 30),
          answer_([socket](std::span<const std::byte> bytes) {
              while (!bytes.empty()) {
                  const ssize_t sent = ::send(socket, bytes.data(), bytes.size(), MSG_NOSIGNAL);
                  if (sent <= 0)
                      return false;
                  bytes = bytes.subspan(std::size_t(sent));
              }
              return true;
          })
    {
    }

    // False: no sensible request came.
    bool listen()
    {
        exchangeRequest(question_, request_);
        return question_.good() && request_.version == kReaderVersion;
    }

    void confineUs()
    {
        dieWith(request_.parent);
        confine();
        setBudget();
        request_.limits.expect = [this](std::size_t bytes) { expect(bytes); };
        watchInputs([this](const std::filesystem::path& file) { tell(file); });
        std::set_new_handler([] { ::_exit(kNoMemoryCode); });
    }

    void read()
    {
        if (request_.kind == ReaderKind::model)
            say(loadScene(request_.name, request_.limits), [&](const Scene& scene) { exchangeScene(answer_, scene); });
        else if (request_.kind == ReaderKind::picture)
            say(decodeImage(request_.bytes, request_.name, request_.limits),
                [&](const Image& image) { exchangeImage(answer_, image); });
        else if (request_.kind == ReaderKind::draco)
            readDraco();
        else
            readRows();
        answer_.flush();
    }

private:
    // More room and time, before so many bytes are decoded. Pictures may be decoded side by side.
    void expect(std::size_t bytes)
    {
        const std::lock_guard lock(mutex_);
        decodedBytes_ += bytes;
        setBudget();
        answer_.choice(ReaderFrame::expect, ReaderFrame::error);
        answer_.number(std::uint64_t(bytes));
        answer_.flush();
    }

    // The parent must not replace what we read.
    void tell(const std::filesystem::path& file)
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

    template<class T, class F> void say(const Result<T>& result, F exchangeValue)
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
            say(decodeDracoHere(jobs),
                [&](const std::vector<DracoGeometry>& meshes) { exchangeDracoGeometry(answer_, meshes); });
    }

    // Strips as long as somebody asks for them.
    void readRows()
    {
        const auto rows = openRows(request_.name, request_.limits);
        say(rows, [&](const std::unique_ptr<RowReader>& open) { exchangeRowFacts(answer_, *open); });
        std::int32_t height = 0;
        for (question_.number(height); rows && question_.good() && height > 0; question_.number(height)) {
            Image strip = makeImage((*rows)->width, height, (*rows)->type);
            rowBytes_ += strip.data.size();
            setBudget();
            say((*rows)->read(strip), [&](Done) { answer_.array(strip.data); });
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
    struct stat status {};
    if (::fstat(0, &status) != 0 || !S_ISSOCK(status.st_mode)) {
        fmt::print(stderr, "{} is for programs that read through this one; nobody asks for anything here\n",
                   kReaderWord);
        return 1;
    }
    // Whatever a library may read or print, it is not this.
    Reader reader(::fcntl(0, F_DUPFD_CLOEXEC, 3));
    ::dup2(2, 0);
    if (!reader.listen())
        return 1;
    reader.confineUs();
    reader.read();
    ::_exit(0); // the parent waits: what is held is given back at once
}

} // namespace cotan
