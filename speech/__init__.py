"""What is said becomes motion of a mouth: sounds in time, visemes, and what feeling adds.

phonemes       speech sounds, their visemes, and the alphabets that write them
utterance      sounds and words in time
line, kept     the same as words to be changed one by one; as presets keep them
voice          text becomes sound and timed phonemes
waves          WAV files
stretching     a sound that lasts longer or shorter at the same pitch
timings        files of aligners and lip-sync tools
articulation   sounds in time become FAPs of mouth, jaw and tongue
accompaniment  what lids, brows and head do with speech
feeling        speech and emotion share a face
recorded       timings, and mouths as they were recorded
saying         the whole: what is said, with feeling, as a stream
glimpse        one moment of it, told from what is near
"""
