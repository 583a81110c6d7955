#include "plants.h"

namespace farol::test {

const std::vector<Plant>& plants() {
    // Severities (two numbers of each row) are hundredths of a mark, thought out by what a teacher
    // would take: a number that is slightly off 4 to 20, a misunderstanding of transforms 6 to 28,
    // a whole picture's light 6 to 20, a small detail of a material 2 to 10. What is missing costs
    // its share of the objects.
    static const std::vector<Plant> kPlants = [] {
        std::vector<Plant> all = placePlants();
        for (const auto& more : {dressPlants(), meshPlants()})
            all.insert(all.end(), more.begin(), more.end());
        return all;
    }();
    return kPlants;
}

}  // namespace farol::test
