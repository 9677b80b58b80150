#ifndef ODE_PREDICTIVE_SPACE_RECORDING_RECORDING_CHECK_H
#define ODE_PREDICTIVE_SPACE_RECORDING_RECORDING_CHECK_H

#include <cstdint>
#include <vector>

#include "ode_predictive_space/recording/record_cursor.h"
#include "ode_predictive_space/recording/recording.h"

namespace ode_predictive_space::recording
{
/// Goes through the records in their order and knows, as a replay would, what there is.
class Recording::Check
{
public:
    explicit Check(Recording &recording) : recording_(recording) {}

    /// @return whether it is whole.
    bool take_header();
    void take_records();

private:
    struct Geom
    {
        int geom_class;
        bool gone = false;
        bool has_body = false;
        std::uint32_t depth = 0; // of the spaces around it
    };
    enum class Shape : std::uint8_t
    {
        mesh,
        convex,
        heightfield
    };

    bool next_record(Record &record) const;
    void take(const Record &record);
    void take_mesh(const Record &record);
    void take_convex(const Record &record);
    void take_heights(const Record &record);
    void take_notices(const Record &record);
    void take_times(const Record &record);
    void take_body(const Record &record);
    void take_geom(const Record &record);
    std::uint32_t depth_in(const RecordCursor &cursor, std::uint32_t parent) const;
    static void check_levels(const RecordCursor &cursor, const SpaceState &state);
    static void check_service(const RecordCursor &cursor, const SpaceService &service);
    static void check_size(const RecordCursor &cursor, const GeomState &state);
    void check_data(const RecordCursor &cursor, const GeomState &state) const;
    void check_version(const RecordCursor &cursor, const GeomChange &change) const;
    static void check_identity(const RecordCursor &cursor, const Geom &geom, const GeomChange &change, bool is_new);
    void add_geom(const RecordCursor &cursor, const GeomChange &change);
    void take_body_of(const RecordCursor &cursor, Geom &geom, const GeomChange &change) const;
    void take_gone(const Record &record);
    void take_event(const Record &record);
    void take_pairs(const Record &record);
    void take_end(const Record &record);
    void take_data_id(RecordCursor &cursor, Shape shape);
    std::uint32_t take_live(RecordCursor &cursor) const;
    void extend(const Pose &pose);

    Recording &recording_;
    std::vector<Geom> geoms_;
    std::vector<Shape> data_;
    bool has_collide_ = false, has_question_ = false;
};
} // namespace ode_predictive_space::recording

#endif
