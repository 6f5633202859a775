// IES TM-27-14, "IES Standard Format for the Electronic Transfer of Spectral Data", through expat.
//
// The namespace is not looked at: the standard's is http://www.ies.org/iestm2714, files in use say "iestm2714", too.
#include <expat.h>

#include <exception>
#include <memory>
#include <optional>
#include <utility>

#include "lightdb/spectrum_rows.h"

namespace seaglare::lightdb {

namespace {

// Elements lie four deep in the standard.
constexpr int deepest = 32;
// A number or a line of description; what is longer is neither.
constexpr std::size_t longest_text = 4096;

std::string_view local_name(std::string_view name) {
    const std::size_t colon = name.rfind(':');
    return colon == std::string_view::npos ? name : name.substr(colon + 1);
}

class SpdxReader {
  public:
    explicit SpdxReader(const std::string& file) : rows_(file), parser_(XML_ParserCreate(nullptr)) {
        if (!parser_) throw std::bad_alloc();
        XML_SetUserData(parser_.get(), this);
        XML_SetElementHandler(parser_.get(), &SpdxReader::start, &SpdxReader::end);
        XML_SetCharacterDataHandler(parser_.get(), &SpdxReader::characters);
        XML_SetStartDoctypeDeclHandler(parser_.get(), &SpdxReader::doctype);
    }

    SpectrumTable read(std::string_view text) {
        const XML_Status status =
            XML_Parse(parser_.get(), text.data(), static_cast<int>(text.size()), XML_TRUE);
        if (failure_) std::rethrow_exception(failure_);
        if (status != XML_STATUS_OK) {
            const XML_Error code = XML_GetErrorCode(parser_.get());
            if (code == XML_ERROR_NO_MEMORY) throw std::bad_alloc();
            rows_.refuse(place(), std::string("not well-formed XML: ") + XML_ErrorString(code));
        }
        return rows_.finished(place());
    }

  private:
    struct Free {
        void operator()(XML_Parser parser) const { XML_ParserFree(parser); }
    };

    TextPlace place() const {
        return {static_cast<std::size_t>(XML_GetCurrentLineNumber(parser_.get())),
                static_cast<std::size_t>(XML_GetCurrentColumnNumber(parser_.get())) + 1};
    }

    // Exceptions must not fly through expat's frames.
    template <class Work>
    static void guarded(void* self, const Work& work) {
        auto& reader = *static_cast<SpdxReader*>(self);
        if (reader.failure_) return;
        try {
            work(reader);
        } catch (...) {
            reader.failure_ = std::current_exception();
            XML_StopParser(reader.parser_.get(), XML_FALSE);
        }
    }
    static void XMLCALL start(void* self, const XML_Char* name, const XML_Char** attributes) {
        guarded(self, [&](SpdxReader& reader) { reader.open(local_name(name), attributes); });
    }
    static void XMLCALL end(void* self, const XML_Char* name) {
        guarded(self, [&](SpdxReader& reader) { reader.close(local_name(name)); });
    }
    static void XMLCALL characters(void* self, const XML_Char* text, int length) {
        guarded(self, [&](SpdxReader& reader) {
            reader.append(std::string_view(text, static_cast<std::size_t>(length)));
        });
    }
    static void XMLCALL doctype(void* self, const XML_Char* /*name*/, const XML_Char* /*system_id*/,
                                const XML_Char* /*public_id*/, int /*has_internal_subset*/) {
        guarded(self, [](SpdxReader& reader) {
            reader.rows_.refuse(reader.place(), "a spectrum file has no DOCTYPE");
        });
    }

    void open(std::string_view name, const XML_Char** attributes) {
        if (++depth_ > deepest) rows_.refuse(place(), "elements lie too deep in each other");
        if (depth_ == 1 && name != "IESTM2714") {
            rows_.refuse(place(), "the root is <" + std::string(name.substr(0, 40)) +
                                      ">, not <IESTM2714>: this is no IES TM-27-14 file");
        }
        if (name == "SpectralDistribution" && std::exchange(has_distribution_, true))
            rows_.refuse(place(), "a second SpectralDistribution: one lamp has one");
        keeps_text_ = name == "SpectralData" || name == "SpectralQuantity" || name == "Description";
        text_.clear();
        if (name != "SpectralData") return;
        row_place_ = place();
        wavelength_nm_.reset();
        for (; *attributes != nullptr; attributes += 2) {
            if (local_name(attributes[0]) != "wavelength") continue;
            double number = 0;
            if (!number_from(without_blanks(attributes[1]), number))
                rows_.refuse(row_place_, "'wavelength' is not a number of nanometres");
            wavelength_nm_ = number;
        }
        if (!wavelength_nm_) rows_.refuse(row_place_, "SpectralData has no attribute 'wavelength'");
    }

    void append(std::string_view text) {
        if (!keeps_text_) return;
        if (text_.empty()) text_place_ = place();
        if (text_.size() + text.size() > longest_text)
            rows_.refuse(place(), "an element has too long a text");
        text_.append(text);
    }

    void close(std::string_view name) {
        --depth_;
        const bool of_this = std::exchange(keeps_text_, false);
        if (!of_this) return;
        const std::string_view text = without_blanks(text_);
        if (name == "Description") {
            rows_.table.description = text;
        } else if (name == "SpectralQuantity") {
            rows_.table.quantity = quantity(text);
        } else if (name == "SpectralData") {
            double value = 0;
            if (!number_from(text, value))
                rows_.refuse(row_place_, "the value of SpectralData is not a number");
            rows_.add(*wavelength_nm_, row_place_, value, text_place_);
        }
    }

    // The words of the standard.
    SpectralQuantity quantity(std::string_view word) const {
        for (const std::string_view power : {"flux", "intensity", "irradiance", "radiance", "exitance"}) {
            if (word == power) return SpectralQuantity::power;
        }
        if (word == "transmittance" || word == "T-Factor") return SpectralQuantity::transmittance;
        if (word == "relative" || word == "other") return SpectralQuantity::unknown;
        if (word == "reflectance" || word == "absorptance" || word == "R-Factor") {
            rows_.refuse(text_place_, "SpectralQuantity is '" + std::string(word) +
                                          "': neither what a lamp sends out nor what a glass lets through");
        }
        rows_.refuse(text_place_, "SpectralQuantity is none that IES TM-27-14 knows");
    }

    SpectrumRows rows_;
    std::unique_ptr<XML_ParserStruct, Free> parser_;
    std::exception_ptr failure_;
    int depth_ = 0;
    bool has_distribution_ = false;
    bool keeps_text_ = false;
    std::string text_;
    TextPlace text_place_;
    TextPlace row_place_;
    std::optional<double> wavelength_nm_;
};

}  // namespace

SpectrumTable parse_spectrum_spdx(std::string_view text, const std::string& file) {
    if (text.size() > largest_spectrum_file_bytes)
        throw SpectrumFileError(file, 1, 1, "the file is too large for a spectrum");
    return SpdxReader(file).read(text);
}

}  // namespace seaglare::lightdb
