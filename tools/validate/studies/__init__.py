"""The papers' cases in the order of their page, then our own studies."""
from tools.validate.studies import (ball_on_plate, dynamic_beam, frequencies, interface, oblique, region_size, rotation,
                                    size_ratio, waves, wide_beam)

STUDIES = [wide_beam.STUDY, size_ratio.STUDY, region_size.STUDY, rotation.STUDY, dynamic_beam.STUDY,
           ball_on_plate.STUDY, interface.STUDY, waves.STUDY, oblique.STUDY, frequencies.STUDY]
