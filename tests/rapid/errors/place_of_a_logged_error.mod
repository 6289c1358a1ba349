! RAPID Instructions, ErrLog: ERRSTR_CONTEXT names the place, the same wherever the program is stored.
MODULE place_of_a_logged_error
  PROC main()
    ErrLog 4800\W,ERRSTR_TASK,ERRSTR_CONTEXT,ERRSTR_UNUSED,ERRSTR_UNUSED,ERRSTR_UNUSED; ! -> warning 4800: T_ROB1 / main, place_of_a_logged_error.mod:4
  ENDPROC
ENDMODULE
