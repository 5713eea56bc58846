"""Live ROS 2, over `rclpy`. Nothing of ROS is imported before a run asks for it."""
