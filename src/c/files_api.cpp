// cotan.h: model and image files.
#include "cotan/image.hpp"
#include "cotan/model.hpp"
#include "cotan/picture.hpp"
#include "image_views.hpp"
#include "meshes.hpp"

using namespace cotan;
using namespace cotan::c;

namespace {

int memoryOf(int megabytes)
{
    require(megabytes >= 0, "memory: expected 0 or more");
    return megabytes != 0 ? megabytes : kDefaultMemory;
}

} // namespace

cotan_status cotan_model_open(const char* file, int images, int memory, cotan_model** model, char* message,
                              size_t message_size)
{
    return call(message, message_size, [&] {
        require(model, "model: expected a pointer, found null");
        const LoadLimits limits = limitsFor(memoryOf(memory), images != 0 ? Pixels::whereReadable : Pixels::none);
        Scene scene = valueOf(loadScene(word(file, "file"), limits));
        std::string warnings = joined(scene.warnings);
        *model = new cotan_model{std::move(scene), std::move(warnings)};
    });
}

cotan_status cotan_set_reader(size_t count, const char* const* words, char* message, size_t message_size)
{
    return call(message, message_size, [&] {
        require(words || count == 0, "words: expected an array, found null");
        Sandbox reader;
        for (std::size_t i = 0; i < count; ++i) {
            const std::string_view given = word(words[i], "words");
            if (i == 0)
                reader.program = given;
            else
                reader.arguments.emplace_back(given);
        }
        sandboxByDefault(std::move(reader));
    });
}

int cotan_reader_process(void) { return runReaderProcess(); }

cotan_status cotan_image_read(const char* file, int memory, cotan_image** image, char* message, size_t message_size)
{
    return call(message, message_size, [&] {
        require(image, "image: expected a pointer, found null");
        *image = new cotan_image{valueOf(readImage(word(file, "file"), limitsFor(memoryOf(memory))))};
    });
}

cotan_status cotan_image_write(const char* file, const cotan_image_view* image, char* message, size_t message_size)
{
    return call(message, message_size, [&] { valueOf(writeImage(word(file, "file"), imageOf(image, "image"))); });
}
