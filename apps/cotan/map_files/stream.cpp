#include "stream.hpp"

#include <algorithm>
#include <atomic>
#include <cstring>
#include <memory>
#include <utility>
#include <vector>

#include "core/try.hpp"
#include "pipeline.hpp"

namespace cotan::app {

using namespace maps;

namespace {

constexpr std::size_t kStripBytes = 16 << 20;     // per strip, of texels as floats
constexpr std::size_t kAllStripBytes = 192 << 20; // of all strips in flight

// Rows per strip: a multiple of 16, as MapSurvey requires, and if possible of 64, for blocks of compression.
int rowsOfStrip(int width)
{
    const std::size_t rows = kStripBytes / (std::size_t(width) * 16);
    if (rows >= 64)
        return int(std::min<std::size_t>(rows, 4096) / 64 * 64);
    return rows >= 16 ? int(rows / 16 * 16) : 16;
}

void copyRow(const Image& from, int row, Image& to, int toRow)
{
    const std::size_t bytes = std::size_t(to.width) * to.bytesPerPixel();
    std::memcpy(to.data.data() + std::size_t(toRow) * bytes, from.data.data() + std::size_t(row) * bytes, bytes);
}

// Reads an image in strips, with the rows beside them.
class StripReader {
public:
    StripReader(RowReader& reader, const StreamPlan& plan) : reader_(reader), plan_(plan) {}

    // Reads the rows [first, last) and their border.
    Result<Image> next(int first, int last)
    {
        const int border = plan_.bordered ? 1 : 0;
        const int end = std::min(last + border, reader_.height); // end of the rows to read
        Image strip = makeImage(reader_.width, last - first + 2 * border, reader_.type, reader_.name);
        int at = 0; // row of the strip
        for (int row = first - border; row < read_; ++row, ++at)
            if (row >= 0)
                copyRow(kept_, row - keptFirst_, strip, at);
        if (!plan_.bordered) {
            COTAN_CHECK(reader_.read(strip));
        } else if (end > read_) {
            Image fresh = makeImage(reader_.width, end - read_, reader_.type, reader_.name);
            COTAN_CHECK(reader_.read(fresh));
            std::ranges::copy(fresh.data, strip.data.begin() + std::ptrdiff_t(std::size_t(at) * rowBytes(strip)));
            read_ = end;
        }
        if (plan_.bordered) {
            setEnds(strip, first, last);
            keep(strip, end - std::min(end, 2), first - border);
        }
        return strip;
    }

private:
    static std::size_t rowBytes(const Image& image) { return std::size_t(image.width) * image.bytesPerPixel(); }

    void setEnds(Image& strip, int first, int last)
    {
        const bool repeat = plan_.wrap == maps::Wrap::repeat;
        if (first == 0) {
            firstRow_ = makeImage(strip.width, 1, strip.type);
            copyRow(strip, 1, firstRow_, 0);
            copyRow(repeat ? *plan_.lastRow : firstRow_, 0, strip, 0);
        }
        if (last == reader_.height) {
            const int bottom = strip.height - 1;
            repeat ? copyRow(firstRow_, 0, strip, bottom) : copyRow(strip, bottom - 1, strip, bottom);
        }
    }

    // Keeps the rows from `from` to the last one read, with which the next strip begins.
    void keep(const Image& strip, int from, int stripFirst)
    {
        Image kept = makeImage(strip.width, read_ - from, strip.type);
        for (int row = from; row < read_; ++row)
            copyRow(strip, row - stripFirst, kept, row - from);
        kept_ = std::move(kept);
        keptFirst_ = from;
    }

    RowReader& reader_;
    const StreamPlan& plan_;
    int read_ = 0;
    Image kept_, firstRow_;
    int keptFirst_ = 0;
};

struct Part {
    int first = 0;
    std::vector<Image> strips;
    std::function<Status()> take;
};

} // namespace

Status streamStrips(std::span<RowReader* const> readers, const StreamPlan& plan, const Progress& progress,
                    const StripWork& work)
{
    const int width = readers[0]->width, height = readers[0]->height, rows = rowsOfStrip(width);
    std::vector<StripReader> stripReaders;
    for (RowReader* reader : readers)
        stripReaders.emplace_back(*reader, plan);
    CountedSteps steps(progress, std::size_t((height + rows - 1) / rows));
    Status readState = Done{}, takeState = Done{}; // each is used by one stage only
    std::atomic<bool> stop = false;
    int next = 0;
    const auto read = [&]() -> std::shared_ptr<Part> {
        auto part = std::make_shared<Part>();
        part->first = next;
        const int last = std::min(next + rows, height);
        for (StripReader& stripReader : stripReaders) {
            if (next >= height || stop)
                break;
            auto strip = stripReader.next(next, last);
            if (!strip) {
                readState = strip.error();
                stop = true;
                break;
            }
            part->strips.push_back(*std::move(strip));
        }
        next = last;
        return part->strips.size() == stripReaders.size() ? part : nullptr;
    };
    const auto run = [&](const std::shared_ptr<Part>& part) {
        part->take = work(part->strips, part->first);
        part->strips.clear();
    };
    const auto give = [&](const std::shared_ptr<Part>& part) {
        if (stop)
            return;
        if (takeState = part->take(); !takeState)
            stop = true;
        part->take = nullptr;
        if (!steps.step())
            stop = true;
    };
    const std::size_t maxStrips = kAllStripBytes / (std::size_t(rows) * std::size_t(width) * 16 * readers.size());
    pipeline(std::clamp(maxStrips, std::size_t(1), std::size_t(loopThreads()) + 2), read, run, give);
    if (readState && takeState && steps.stopped())
        return stoppedError();
    return readState ? takeState : readState;
}

Status inOrder(RowReader& reader, const Progress& progress,
               const std::function<void(const Image& strip, int firstRow)>& take)
{
    RowReader* const readers[] = {&reader};
    return streamStrips(readers, {}, progress, [&](std::span<Image> strips, int firstRow) {
        return [&take, firstRow, strip = std::move(strips[0])]() -> Status {
            take(strip, firstRow);
            return Done{};
        };
    });
}

Status streamToFile(RowReader& reader, const StreamPlan& plan, const std::filesystem::path& file,
                    const RowFormat& format, int threads, const Progress& progress,
                    const std::function<Image(Image& strip, int firstRow)>& work)
{
    COTAN_TRY(writer, createRows(file, format, threads));
    RowReader* const readers[] = {&reader};
    const Status done = streamStrips(readers, plan, progress, [&](std::span<Image> strips, int firstRow) {
        return [&writer, out = work(strips[0], firstRow)] { return (*writer)->write(out); };
    });
    return done ? (*writer)->finish() : done;
}

Result<Image> lastRowOf(const std::filesystem::path& file, const LoadLimits& limits)
{
    COTAN_TRY(reader, openRows(file, limits));
    RowReader& rows = **reader;
    const int step = rowsOfStrip(rows.width);
    for (int y = 0; y < rows.height;) {
        const int count = std::min(step, rows.height - 1 - y);
        Image strip = makeImage(rows.width, count > 0 ? count : 1, rows.type);
        COTAN_CHECK(rows.read(strip));
        y += strip.height;
        if (y == rows.height)
            return strip;
    }
    return inputError(rows.name + ": there are no rows");
}

} // namespace cotan::app
