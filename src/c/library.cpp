// cotan.h: the library itself.
#include "call.hpp"

const void* cotan_bytes_data(const cotan_bytes* bytes) { return bytes ? bytes->data.data() : nullptr; }
size_t cotan_bytes_size(const cotan_bytes* bytes) { return bytes ? bytes->data.size() : 0; }
void cotan_bytes_free(cotan_bytes* bytes) { delete bytes; }

const char* cotan_version(void) { return COTAN_VERSION; }
int cotan_api_version(void) { return COTAN_API_VERSION; }
