// libFuzzer target: no text crashes the reader of ANSI/IES LM-63 files, and what it reads is a grid of candela.
#include "tests/fuzz/photometry_check.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    seaglare::fuzz::check_photometry(
        data, size, [](std::string_view text) { return seaglare::lightdb::parse_ies(text, "fuzz"); });
    return 0;
}
