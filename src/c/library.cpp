// cotan.h: the library itself.
#include "call.hpp"

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
