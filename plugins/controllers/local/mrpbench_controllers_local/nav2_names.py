"""Parameters of Nav2's controllers, critics and costmaps that have no effect here, of all releases from eloquent on."""

from mrpbench_native.local import controller_options

OF_SHIM = (
    *("forward_sampling_distance", "angular_dist_threshold", "angular_disengage_threshold", "max_angular_accel"),
    *("rotate_to_heading_angular_vel", "simulate_ahead_time", "rotate_to_goal_heading", "rotate_to_heading_once"),
    *("closed_loop", "use_path_orientations", "max_cost_threshold"),
)
"""Parameters of Nav2's rotation shim, which the plugin `rotation_shim` reads."""
OF_CONTROLLERS = (
    # DWB: what it publishes, sideways motion, and its path, which the navigator cuts here
    *("debug_trajectory_details", "publish_evaluation", "publish_global_plan", "publish_transformed_plan"),
    *("publish_local_plan", "publish_trajectories", "publish_cost_grid_pc", "publish_input_params", "marker_lifetime"),
    *("min_vel_y", "max_vel_y", "vy_samples", "acc_lim_y", "decel_lim_y", "forward_prune_distance", "prune_plan"),
    *("transform_tolerance", "stateful", "default_critic_namespaces", "sim_period", "goal_checker_name", "use_dwa"),
    *("limit_vel_cmd_in_traj", "split_path", "path_length_tolerance", "xy_goal_tolerance", "yaw_goal_tolerance"),
    *("trans_stopped_velocity", "rot_stopped_velocity", "critics"),
    # MPPI
    *("visualize", "publish_critics_stats", "publish_optimal_trajectory", "critic_index_to_visualize", "motion_model"),
    *("reset_period", "vy_std", "vy_max", "ay_max", "ay_min", "model_delay_vy", "max_robot_pose_search_dist"),
    *("enforce_path_inversion", "inversion_xy_tolerance", "inversion_yaw_tolerance", "minimum_rotation_angle"),
    # regulated pure pursuit
    *("use_cancel_deceleration", "cancel_deceleration", "use_interpolation", "min_distance_to_obstacle"),
    *("allow_obstacle_checking_beyond_goal", "goal_dist_tol", "max_allowed_time_to_collision", "desired_linear_vel"),
    *("use_approach_linear_velocity_scaling", "use_approach_vel_scaling"),
    # graceful
    *("min_lookahead", "lambda", "motion_target_dist", "initial_rotation_min_angle", "final_rotation"),
    *(*OF_SHIM, "primary_controller"),
    # what another controller reads
    *(row.name for name in ("dwb", "mppi", "rpp", "graceful") for row in controller_options(name)),
)
OF_CRITICS = (
    *("inflation_layer_name", "use_path_orientations", "forward_preference", "cost_scaling_factor"),
    *("inflation_radius", "path_point_step", "deadband_velocities", "twirling_cost_power", "twirling_cost_weight"),
)
OF_PATH_HANDLERS = (
    *("max_robot_pose_search_dist", "enforce_path_inversion", "enforce_path_rotation"),
    *("inversion_xy_tolerance", "inversion_yaw_tolerance", "minimum_rotation_angle", "reject_unit_path"),
    "transform_tolerance",
)
OF_COSTMAPS = (
    *("publish_frequency", "global_frame", "robot_base_frame", "rolling_window", "always_send_full_costmap"),
    *("transform_tolerance", "initial_transform_timeout", "track_unknown_space", "origin_x", "origin_y", "map_topic"),
    *("lethal_cost_threshold", "unknown_cost_value", "trinary_costmap", "use_maximum", "map_vis_z", "footprint_topic"),
    *("clearable_layers", "inscribed_obstacle_cost_value", "subscribe_to_stamped_footprint", "observation_sources"),
    "map_subscribe_transient_local",
)
OF_LAYERS = (
    # the third dimension, topics, and unknown cells, which do not exist here
    *("publish_voxel_map", "origin_z", "z_resolution", "z_voxels", "max_obstacle_height", "min_obstacle_height"),
    *("mark_threshold", "unknown_threshold", "track_unknown_space", "combination_method", "tf_filter_tolerance"),
    *("map_subscribe_transient_local", "subscribe_to_updates", "map_topic", "transform_tolerance"),
    *("restore_cleared_footprint", "footprint_clearing_enabled", "inflate_unknown", "inflate_around_unknown"),
    *("observation_sources", "num_threads", "lethal_cost_threshold", "trinary_costmap", "unknown_cost_value"),
    # what another layer reads
    *("inflation_radius", "cost_scaling_factor"),
)
OF_SOURCES = (
    *("topic", "max_obstacle_height", "min_obstacle_height", "sensor_frame", "expected_update_rate"),
    *("transport_type", "observation_queue_length"),
)
OLDER_RANGES = {"obstacle_range": "obstacle_max_range", "raytrace_range": "raytrace_max_range"}
"""Names of the parameters of observation sources until foxy."""
HERE = {
    "dwb_core::DWBLocalPlanner": "dwb",
    "nav2_mppi_controller::MPPIController": "mppi",
    "nav2_regulated_pure_pursuit_controller::RegulatedPurePursuitController": "rpp",
    "nav2_graceful_controller::GracefulController": "graceful",
    "nav2_rotation_shim_controller::RotationShimController": "rotation_shim",
}
"""The plugins of controllers by their names in Nav2."""
