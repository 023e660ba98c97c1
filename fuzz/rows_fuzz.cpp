// Reads images by rows: strips of any height must give the same pixels as the whole image, and an image whose rows can
// be opened must be accepted by both methods or refused by both.
#include <algorithm>

#include "cotan/image.hpp"
#include "fuzz.hpp"
#include "limits.hpp"

using namespace cotan;
using namespace cotan::fuzz;

namespace {

// Reads all rows in strips of `rows`. Returns the first error, if any.
Result<Image> readByRows(RowReader& reader, int rows)
{
    Image whole = makeImage(reader.width, reader.height, reader.type);
    const std::size_t rowBytes = std::size_t(reader.width) * whole.bytesPerPixel();
    for (int y = 0; y < reader.height; y += rows) {
        Image strip = makeImage(reader.width, std::min(rows, reader.height - y), reader.type);
        if (Status read = reader.read(strip); !read)
            return read.error();
        std::memcpy(whole.data.data() + std::size_t(y) * rowBytes, strip.data.data(), strip.data.size());
    }
    return whole;
}

} // namespace

// The first byte determines the height of the strips.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    static const Scratch scratch;
    if (size < 2)
        return 0;
    const auto file = scratch.write("picture.tga", {data + 1, size - 1});
    const auto reader = openRows(file, smallLimits());
    if (!reader) {
        checkError(reader.error());
        return 0;
    }
    RowReader& rows = **reader;
    COTAN_HOLDS(rows.width > 0 && rows.height > 0, "{} x {}", rows.width, rows.height);
    if (std::size_t(rows.width) * std::size_t(rows.height) > 1 << 22)
        return 0;
    const auto byRows = readByRows(rows, 1 + data[0] % 64);
    const auto whole = readImage(file, smallLimits());
    if (!byRows)
        checkError(byRows.error());
    if (!whole)
        checkError(whole.error());
    if (byRows && whole)
        COTAN_HOLDS(byRows->width == whole->width && byRows->height == whole->height && byRows->type == whole->type
                        && byRows->data == whole->data,
                    "{} x {}", whole->width, whole->height);
    COTAN_HOLDS(bool(byRows) || !whole, "only whole: {}", byRows ? "" : byRows.error().message);
    COTAN_HOLDS(bool(whole) || !byRows, "only by rows: {}", whole ? "" : whole.error().message);
    return 0;
}
