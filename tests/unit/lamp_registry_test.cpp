// More named spectra than there are patterns: who has one keeps it, the others take the nearest.
#include "lightdb/lamp_registry.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "glare/colour/named_spectra.h"

namespace seaglare::lightdb {
namespace {

SharedLamp planck(double kelvin) {
    const auto spectrum = glare::named_spectrum(glare::planck_name(kelvin));
    return std::make_shared<const glare::LampSpectrum>(glare::LampSpectrum::from(*spectrum).value());
}

constexpr int named_slots = glare::most_lamps - glare::lamp_count;
double kelvin_of(int i) {
    return 1500 + 100 * i;
}

struct Filled {
    LampRegistry registry;
    std::vector<LampRegistry::Index> entries;
    explicit Filled(int spectra) {
        for (int i = 0; i < spectra; ++i)
            entries.push_back(registry.intern(planck(kelvin_of(i))));
    }
};

TEST(LampRegistry, EveryNamedSpectrumHasAPatternUntilThereIsNoMoreRoom) {
    const Filled full(named_slots);
    EXPECT_EQ(full.registry.without_slot(), 0U);
    std::vector<bool> taken(glare::most_lamps);
    for (const auto entry : full.entries) {
        EXPECT_TRUE(full.registry[entry].own_slot);
        ASSERT_GE(full.registry[entry].lamp, glare::lamp_count);
        EXPECT_FALSE(taken[full.registry[entry].lamp]) << "two spectra with one pattern";
        taken[full.registry[entry].lamp] = true;
    }
}

TEST(LampRegistry, ASpectrumBeyondTakesTheNearestPatternAndItsOwnColour) {
    constexpr int too_many = 4;
    Filled full(named_slots);
    const auto before = full.registry.list();
    std::vector<LampRegistry::Index> late;
    for (int i = 0; i < too_many; ++i)
        late.push_back(full.registry.intern(planck(1510 + 300 * i)));
    EXPECT_EQ(full.registry.without_slot(), too_many);
    for (int i = 0; i < too_many; ++i) {
        const LampRegistry::Entry& entry = full.registry[late[static_cast<std::size_t>(i)]];
        EXPECT_FALSE(entry.own_slot);
        EXPECT_EQ(entry.colour.rgb, planck(1510 + 300 * i)->colour().rgb);
        const glare::LampList& list = *full.registry.list();
        double least = std::numeric_limits<double>::infinity();
        for (const auto& spectrum : list.spectra)
            if (spectrum) least = std::min(least, glare::spectral_distance_nm(*spectrum, *entry.spectrum));
        EXPECT_NEAR(glare::spectral_distance_nm(*list.spectra[entry.lamp], *entry.spectrum), least, 1e-4);
        // Ten kelvin from a lamp that has a pattern: the same one, but for a fraction of a nanometre.
        EXPECT_LT(least, 0.5) << i;
    }
    for (std::size_t lamp = glare::lamp_count; lamp < before->spectra.size(); ++lamp)
        EXPECT_TRUE(full.registry.list()->spectra[lamp] == before->spectra[lamp])
            << "who has a pattern keeps it: " << lamp;
}

TEST(LampRegistry, APlaceThatBecomesFreeGoesToWhoHadNone) {
    Filled full(named_slots);
    const auto late = full.registry.intern(planck(9000));
    EXPECT_FALSE(full.registry[late].own_slot);
    const auto freed = full.registry[full.entries[3]].lamp;
    full.registry.release(full.entries[3]);
    // At the next change.
    const auto next = full.registry.intern(planck(12000));
    EXPECT_EQ(full.registry.without_slot(), 1U);
    EXPECT_NE(full.registry[late].own_slot, full.registry[next].own_slot);
    const auto owner = full.registry[late].own_slot ? late : next;
    EXPECT_EQ(full.registry[owner].lamp, freed);
}

TEST(LampRegistry, OneSpectrumIsOneEntryHoweverManyLightsHaveIt) {
    LampRegistry registry;
    const auto first = registry.intern(planck(2700));
    EXPECT_EQ(registry.intern(planck(2700)), first);
    EXPECT_EQ(registry[first].users, 2U);
    registry.release(first);
    EXPECT_EQ(registry[first].users, 1U);
    EXPECT_TRUE(registry[first].spectrum);
    registry.release(first);
    EXPECT_FALSE(registry[first].spectrum);
    // D65 is the white navigation lamp's: no second pattern for it.
    const auto white = registry.intern(std::make_shared<const glare::LampSpectrum>(
        glare::LampSpectrum::from(*glare::named_spectrum("d65")).value()));
    EXPECT_EQ(registry[white].lamp, 0);
    EXPECT_TRUE(registry[white].own_slot);
}

}  // namespace
}  // namespace seaglare::lightdb
