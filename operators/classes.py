"""Every class that Blender is given, in the order in which it is given: what others refer to comes first."""

from __future__ import annotations

from .bake.ops import (
    RISORIUS_OT_bake_again,
    RISORIUS_OT_bake_expression,
    RISORIUS_OT_bake_motion,
    RISORIUS_OT_bake_strips,
    RISORIUS_OT_clear,
)
from .bake.panel import RISORIUS_PT_bake
from .bake.props import RISORIUS_PG_bake
from .emotion.ops import RISORIUS_OT_reset_activation
from .emotion.panel import RISORIUS_PT_emotion
from .emotion.props import RISORIUS_PG_emotion
from .face.lips import RISORIUS_OT_cut_lips, RISORIUS_OT_line_mouth
from .face.ops import RISORIUS_OT_add_head, RISORIUS_OT_forget_points, RISORIUS_OT_import_points
from .face.panel import RISORIUS_PT_main
from .face.props import RISORIUS_PG_face
from .face.six import RISORIUS_OT_bake_six
from .film.ops import RISORIUS_OT_export_gltf, RISORIUS_OT_render_film
from .film.panel import RISORIUS_PT_film
from .film.props import RISORIUS_PG_film
from .followers.ops import RISORIUS_OT_add_followers, RISORIUS_OT_find_followers, RISORIUS_OT_remove_follower
from .followers.panel import RISORIUS_PT_followers, RISORIUS_UL_followers
from .followers.props import RISORIUS_PG_follower
from .kept.ops import RISORIUS_OT_clear_kept_faces
from .kept.props import RISORIUS_AP_preferences
from .library.ops import RISORIUS_OT_load_preset, RISORIUS_OT_save_preset
from .library.panel import RISORIUS_FH_preset, RISORIUS_MT_library
from .muscles.ops import RISORIUS_OT_reset_muscles
from .muscles.panel import RISORIUS_PT_muscles, RISORIUS_UL_muscles
from .muscles.props import RISORIUS_PG_by_hand, RISORIUS_PG_muscle_list, RISORIUS_PG_muscle_name, RISORIUS_PG_muscles
from .parts.ops import RISORIUS_OT_find_parts, RISORIUS_OT_forget_parts, RISORIUS_OT_set_part
from .parts.panel import RISORIUS_PT_parts
from .parts.props import RISORIUS_PG_parts
from .points.click import RISORIUS_OT_click_points
from .points.drag import RISORIUS_OT_drag_point, RISORIUS_OT_use_drag_tool
from .points.hover import RISORIUS_GGT_point_names, RISORIUS_GT_point_names
from .points.joined import RISORIUS_OT_take_over_points
from .points.look import RISORIUS_OT_look_at_face
from .points.ops import (
    RISORIUS_OT_export_points,
    RISORIUS_OT_find_points,
    RISORIUS_OT_follow_mesh,
    RISORIUS_OT_jump_to_point,
    RISORIUS_OT_reset_points,
)
from .points.panel import RISORIUS_PT_points, RISORIUS_UL_points
from .points.props import RISORIUS_PG_point_name, RISORIUS_PG_points
from .points.question import RISORIUS_MT_is_this_the_face, RISORIUS_OT_accept_points
from .points.topologies import RISORIUS_OT_remove_topology, RISORIUS_OT_save_topology
from .points.topologies_panel import RISORIUS_PT_topologies
from .preview.props import RISORIUS_PG_preview
from .props import RISORIUS_PG_object, RISORIUS_PG_scene, RISORIUS_PG_window
from .read.ops import RISORIUS_OT_clear_reading, RISORIUS_OT_read_animation, RISORIUS_OT_show_beliefs
from .read.panel import RISORIUS_PT_read, RISORIUS_PT_read_faps, RISORIUS_PT_read_features
from .read.props import RISORIUS_PG_read
from .recording.handler import RISORIUS_FH_fap
from .recording.ops import RISORIUS_OT_bake_recording, RISORIUS_OT_import_fap
from .recording.props import RISORIUS_PG_recording
from .shapes.ops import RISORIUS_OT_make_shapes
from .shapes.props import RISORIUS_PG_shapes
from .show.props import RISORIUS_PG_show
from .speech.ops import RISORIUS_OT_speak
from .speech.panel import RISORIUS_PT_speech, RISORIUS_UL_speech
from .speech.props import RISORIUS_PG_speech
from .speech.strip_ops import (
    RISORIUS_OT_add_speech,
    RISORIUS_OT_fit_speech_sound,
    RISORIUS_OT_remove_speech,
    RISORIUS_OT_remove_stray_sounds,
    RISORIUS_OT_stretch_speech,
)
from .speech.strip_props import RISORIUS_PG_said_sound, RISORIUS_PG_said_word, RISORIUS_PG_speech_strip
from .speech.word_ops import (
    RISORIUS_OT_add_sound,
    RISORIUS_OT_insert_word,
    RISORIUS_OT_join_words,
    RISORIUS_OT_pronounce_word,
    RISORIUS_OT_remove_sound,
    RISORIUS_OT_remove_word,
    RISORIUS_OT_select_word,
    RISORIUS_OT_split_word,
)
from .speech.word_panel import RISORIUS_PT_words, RISORIUS_UL_said_sounds, RISORIUS_UL_words
from .timeline.drag import RISORIUS_OT_drag_clip
from .timeline.ops import (
    RISORIUS_MT_clips,
    RISORIUS_OT_add_clip,
    RISORIUS_OT_clear_clips,
    RISORIUS_OT_duplicate_clip,
    RISORIUS_OT_move_clip,
    RISORIUS_OT_remove_clip,
    RISORIUS_OT_sort_clips,
)
from .timeline.panel import RISORIUS_PT_timeline, RISORIUS_PT_variation, RISORIUS_UL_clips
from .timeline.props import RISORIUS_PG_clip, RISORIUS_PG_timeline, RISORIUS_PG_variation
from .timeline.timing import RISORIUS_MT_clip_timing, RISORIUS_OT_time_clip
from .tissue.ops import RISORIUS_OT_add_tissue_preset
from .tissue.panel import RISORIUS_PT_tissue, RISORIUS_PT_tissue_presets
from .tissue.props import RISORIUS_PG_tissue
from .wheel.gizmo import RISORIUS_GGT_wheel, RISORIUS_GT_wheel
from .wheel.ops import RISORIUS_OT_drag_emotion, RISORIUS_OT_nudge_emotion
from .wheel.panel import RISORIUS_PT_wheel
from .wheel.pick import RISORIUS_OT_pick_emotion
from .wheel.props import RISORIUS_PG_wheel

#: Groups of properties.
PROPERTIES = (
    RISORIUS_AP_preferences,
    RISORIUS_PG_follower,
    RISORIUS_PG_face,
    RISORIUS_PG_emotion,
    RISORIUS_PG_by_hand,
    RISORIUS_PG_muscles,
    RISORIUS_PG_muscle_name,
    RISORIUS_PG_muscle_list,
    RISORIUS_PG_tissue,
    RISORIUS_PG_clip,
    RISORIUS_PG_variation,
    RISORIUS_PG_timeline,
    RISORIUS_PG_bake,
    RISORIUS_PG_recording,
    RISORIUS_PG_said_sound,
    RISORIUS_PG_said_word,
    RISORIUS_PG_speech_strip,
    RISORIUS_PG_speech,
    RISORIUS_PG_film,
    RISORIUS_PG_shapes,
    RISORIUS_PG_read,
    RISORIUS_PG_point_name,
    RISORIUS_PG_points,
    RISORIUS_PG_parts,
    RISORIUS_PG_wheel,
    RISORIUS_PG_preview,
    RISORIUS_PG_show,
    RISORIUS_PG_object,
    RISORIUS_PG_scene,
    RISORIUS_PG_window,
)
#: What buttons, keys and menus do.
OPERATORS = (
    RISORIUS_OT_add_head,
    RISORIUS_OT_import_points,
    RISORIUS_OT_forget_points,
    RISORIUS_OT_find_points,
    RISORIUS_OT_jump_to_point,
    RISORIUS_OT_reset_points,
    RISORIUS_OT_follow_mesh,
    RISORIUS_OT_export_points,
    RISORIUS_OT_accept_points,
    RISORIUS_MT_is_this_the_face,
    RISORIUS_OT_look_at_face,
    RISORIUS_OT_click_points,
    RISORIUS_OT_drag_point,
    RISORIUS_OT_use_drag_tool,
    RISORIUS_GT_point_names,
    RISORIUS_GGT_point_names,
    RISORIUS_OT_take_over_points,
    RISORIUS_OT_save_topology,
    RISORIUS_OT_remove_topology,
    RISORIUS_OT_find_followers,
    RISORIUS_OT_add_followers,
    RISORIUS_OT_remove_follower,
    RISORIUS_OT_find_parts,
    RISORIUS_OT_set_part,
    RISORIUS_OT_forget_parts,
    RISORIUS_OT_reset_activation,
    RISORIUS_OT_drag_emotion,
    RISORIUS_OT_nudge_emotion,
    RISORIUS_OT_pick_emotion,
    RISORIUS_OT_reset_muscles,
    RISORIUS_OT_add_tissue_preset,
    RISORIUS_OT_add_clip,
    RISORIUS_OT_duplicate_clip,
    RISORIUS_OT_remove_clip,
    RISORIUS_OT_move_clip,
    RISORIUS_OT_sort_clips,
    RISORIUS_OT_clear_clips,
    RISORIUS_OT_time_clip,
    RISORIUS_MT_clip_timing,
    RISORIUS_MT_clips,
    RISORIUS_OT_drag_clip,
    RISORIUS_OT_bake_expression,
    RISORIUS_OT_bake_motion,
    RISORIUS_OT_bake_strips,
    RISORIUS_OT_bake_again,
    RISORIUS_OT_clear,
    RISORIUS_OT_cut_lips,
    RISORIUS_OT_line_mouth,
    RISORIUS_OT_bake_six,
    RISORIUS_OT_save_preset,
    RISORIUS_OT_clear_kept_faces,
    RISORIUS_OT_load_preset,
    RISORIUS_OT_bake_recording,
    RISORIUS_OT_import_fap,
    RISORIUS_OT_speak,
    RISORIUS_OT_add_speech,
    RISORIUS_OT_remove_speech,
    RISORIUS_OT_remove_stray_sounds,
    RISORIUS_OT_fit_speech_sound,
    RISORIUS_OT_stretch_speech,
    RISORIUS_OT_select_word,
    RISORIUS_OT_split_word,
    RISORIUS_OT_join_words,
    RISORIUS_OT_remove_word,
    RISORIUS_OT_insert_word,
    RISORIUS_OT_pronounce_word,
    RISORIUS_OT_add_sound,
    RISORIUS_OT_remove_sound,
    RISORIUS_OT_render_film,
    RISORIUS_OT_export_gltf,
    RISORIUS_OT_make_shapes,
    RISORIUS_OT_read_animation,
    RISORIUS_OT_show_beliefs,
    RISORIUS_OT_clear_reading,
)
#: What is seen, in the order of work, which is that of the sidebar.
PANELS = (
    RISORIUS_PT_main,
    RISORIUS_UL_followers,
    RISORIUS_PT_followers,
    RISORIUS_PT_parts,
    RISORIUS_UL_points,
    RISORIUS_PT_points,
    RISORIUS_PT_topologies,
    RISORIUS_PT_emotion,
    RISORIUS_PT_wheel,
    RISORIUS_GT_wheel,
    RISORIUS_GGT_wheel,
    RISORIUS_UL_muscles,
    RISORIUS_PT_muscles,
    RISORIUS_PT_tissue_presets,
    RISORIUS_PT_tissue,
    RISORIUS_UL_clips,
    RISORIUS_PT_timeline,
    RISORIUS_PT_variation,
    RISORIUS_MT_library,
    RISORIUS_FH_preset,
    RISORIUS_FH_fap,
    RISORIUS_UL_speech,
    RISORIUS_PT_speech,
    RISORIUS_UL_words,
    RISORIUS_UL_said_sounds,
    RISORIUS_PT_words,
    RISORIUS_PT_bake,
    RISORIUS_PT_read,
    RISORIUS_PT_read_faps,
    RISORIUS_PT_read_features,
    RISORIUS_PT_film,
)

CLASSES: tuple[type, ...] = (*PROPERTIES, *OPERATORS, *PANELS)
