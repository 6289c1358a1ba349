! RAPID Data types, motsetdata: only instructions change what C_MOTSET and C_PROGDISP tell.
MODULE settings_read_only
  PROC main()
    C_MOTSET.vel.oride:=50;                 ! error: T304
    C_PROGDISP.eoffs:=[0,0,0,0,0,0];        ! error: T304
    Incr C_MOTSET.vel.oride;                ! error: T303
  ENDPROC
ENDMODULE
