! RAPID Data types, motsetdata: C_MOTSET tells what instructions have set.
MODULE settings_in_force
  PROC main()
    TPWrite ValToStr(C_MOTSET.vel);         ! -> [100,5000]
    VelSet 50,800;
    TPWrite ValToStr(C_MOTSET.vel);         ! -> [50,800]
    AccSet 40,60;
    TPWrite ValToStr(C_MOTSET.acc);         ! -> [40,60,100]
    TPWrite ValToStr(C_MOTSET.conf);        ! -> [TRUE,TRUE,30,180,90]
    ConfL\Off;
    TPWrite ValToStr(C_MOTSET.conf.lsup);   ! -> FALSE
    SingArea\Wrist;
    TPWrite ValToStr(C_MOTSET.sing);        ! -> [TRUE,FALSE,FALSE,FALSE]
    WorldAccLim\On:=3;
    TPWrite ValToStr(C_MOTSET.worldaccmax); ! -> 3
  ENDPROC
ENDMODULE
