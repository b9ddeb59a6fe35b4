# Writes the sample face's meshes and converts them to FOLDER/sample.sweep.
file(REMOVE_RECURSE ${FOLDER})
execute_process(COMMAND ${SAMPLE_FACE} ${FOLDER} COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${TOOL} convert ${FOLDER}/neutral.obj ${FOLDER}/expressions
  -o ${FOLDER}/sample.sweep --tolerance 0.02 COMMAND_ERROR_IS_FATAL ANY)
