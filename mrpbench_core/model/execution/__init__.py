"""The data that simulator, localizer, dispatcher, navigator and controller exchange in every control period."""
