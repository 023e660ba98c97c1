#include "map_stream.hpp"

#include <algorithm>
#include <atomic>
#include <cstring>
#include <utility>

#include "cotan/parallel/loops.hpp"
#include "progress.hpp"

namespace cotan::app {

namespace {

constexpr std::size_t kStripBytes = 16 << 20;    // of texels, as floats
constexpr std::size_t kAllStripBytes = 192 << 20; // of the strips under way

// A multiple of 16 where it can be, as maps::MapSurvey wants, and of 64 for blocks of compression.
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

// Cuts one picture into strips, with the rows beside them.
class Cutter {
public:
    Cutter(RowReader& reader, const StreamPlan& plan) : reader_(reader), plan_(plan) {}

    // The rows [first, last) and their border.
    Result<Image> next(int first, int last)
    {
        const int above = plan_.border == Border::both, below = plan_.border != Border::none;
        const int end = std::min(last + below, reader_.height); // what has to be read
        Image strip = makeImage(reader_.width, last - first + above + (plan_.border == Border::both ? 1 : end - last),
                                reader_.type, reader_.name);
        int at = 0; // of the strip
        for (int row = first - above; row < read_; ++row, ++at)
            if (row >= 0)
                copyRow(kept_, row - keptFirst_, strip, at);
        if (plan_.border == Border::none) {
            if (Status read = reader_.read(strip); !read)
                return read.error();
        } else if (end > read_) {
            Image fresh = makeImage(reader_.width, end - read_, reader_.type, reader_.name);
            if (Status read = reader_.read(fresh); !read)
                return read.error();
            std::ranges::copy(fresh.data, strip.data.begin() + std::ptrdiff_t(std::size_t(at) * rowBytes(strip)));
            read_ = end;
        }
        if (plan_.border == Border::both)
            setEnds(strip, first, last);
        keep(strip, end - std::min(end, 2), first - above);
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

    // The rows from `from` to the last one read, which the next strip begins with.
    void keep(const Image& strip, int from, int stripFirst)
    {
        if (plan_.border == Border::none)
            return;
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

Status streamStrips(const CommonOptions& options, std::span<RowReader* const> readers, const StreamPlan& plan,
                    const StripWork& work)
{
    const int width = readers[0]->width, height = readers[0]->height, rows = rowsOfStrip(width);
    std::vector<Cutter> cutters;
    for (RowReader* reader : readers)
        cutters.emplace_back(*reader, plan);
    Progress progress(options, std::size_t((height + rows - 1) / rows), readers[0]->name);
    Status readState = Done{}, takeState = Done{}; // each touched by one stage only
    std::atomic<bool> stop = false;
    int next = 0;
    const auto read = [&]() -> std::shared_ptr<Part> {
        auto part = std::make_shared<Part>();
        part->first = next;
        const int last = std::min(next + rows, height);
        for (Cutter& cutter : cutters) {
            if (next >= height || stop)
                break;
            auto strip = cutter.next(next, last);
            if (!strip) {
                readState = strip.error();
                stop = true;
                break;
            }
            part->strips.push_back(*std::move(strip));
        }
        next = last;
        return part->strips.size() == cutters.size() ? part : nullptr;
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
        progress.step();
    };
    const std::size_t most = kAllStripBytes / (std::size_t(rows) * std::size_t(width) * 16 * readers.size());
    pipeline(std::clamp(most, std::size_t(1), std::size_t(loopThreads()) + 2), read, run, give);
    return readState ? takeState : readState;
}

Status inOrder(const CommonOptions& options, RowReader& reader, Border border,
               const std::function<void(const Image& strip, int firstRow)>& take)
{
    RowReader* const readers[] = {&reader};
    return streamStrips(options, readers, {border}, [&](std::span<Image> strips, int firstRow) {
        return [&take, firstRow, strip = std::move(strips[0])]() -> Status {
            take(strip, firstRow);
            return Done{};
        };
    });
}

Result<Image> lastRowOf(const std::filesystem::path& file, const MapOptions& options)
{
    const auto reader = openMapRows(file, options);
    if (!reader)
        return reader.error();
    RowReader& rows = **reader;
    const int step = rowsOfStrip(rows.width);
    for (int y = 0; y < rows.height;) {
        const int count = std::min(step, rows.height - 1 - y);
        Image strip = makeImage(rows.width, count > 0 ? count : 1, rows.type);
        if (Status read = rows.read(strip); !read)
            return read.error();
        y += strip.height;
        if (y == rows.height)
            return strip;
    }
    return inputError(rows.name + ": there are no rows");
}

} // namespace cotan::app
