// cotan.h: the library itself.
#include "call.hpp"
#include "core/file_names.hpp"

namespace cotan::c {

cotan_status callCaught(char* message, std::size_t size, void (*run)(void*), void* work)
try {
    copyText("", message, size);
    run(work);
    return COTAN_OK;
} catch (const Error& error) {
    return refused(error, message, size);
} catch (const std::bad_alloc&) {
    return refused(ErrorKind::unavailable, "not enough memory", message, size);
} catch (const std::exception& e) {
    return refused(ErrorKind::unavailable, e.what(), message, size);
}

} // namespace cotan::c

const void* cotan_bytes_data(const cotan_bytes* bytes) { return bytes ? bytes->data.data() : nullptr; }
size_t cotan_bytes_size(const cotan_bytes* bytes) { return bytes ? bytes->data.size() : 0; }
void cotan_bytes_free(cotan_bytes* bytes) { delete bytes; }

const char* cotan_version(void) { return COTAN_VERSION; }
int cotan_api_version(void) { return COTAN_API_VERSION; }

cotan_status cotan_file_names(size_t count, const char* const* names, size_t taken_count, const char* const* taken,
                              cotan_bytes** parts, char* message, size_t message_size)
{
    return cotan::c::call(message, message_size, [&] {
        std::string lines;
        for (const std::string& part : cotan::fileNameParts(cotan::c::textsOf(count, names, "names"),
                                                            cotan::c::textsOf(taken_count, taken, "taken")))
            lines += part + "\n";
        cotan::c::giveText(lines, parts);
    });
}
