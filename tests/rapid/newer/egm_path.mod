! RAPID Instructions, EGMMoveL: where no sensor answers, the time-out is an error of the move, and the
! robot stands on its path.
MODULE egm_path
  VAR egmident guide;
  CONST robtarget start:=[[800,-100,600],[0,0,1,0],[-1,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];

  PROC main()
    VAR robtarget here;
    MoveL start,v500,fine,tool0;
    EGMGetId guide;
    EGMSetupUC ROB_1,guide,"default","UCdevice"\PathCorr\APTR\CommTimeout:=0.5;
    EGMActMove guide,[[0,0,0],[1,0,0,0]]\SampleRate:=48;
    EGMMoveL guide,Offs(start,0,90,0),v50,fine,tool0;    ! warning: R150
    TPWrite "after it";                      ! -> after it
  ERROR
    IF ERRNO=ERR_UDPUC_COMM THEN
      here:=CRobT(\Tool:=tool0);
      TPWrite "on the path "+ValToStr(Abs(here.trans.x-800)<0.01);     ! -> on the path TRUE
      TPWrite "half way "+ValToStr(here.trans.y<-30);                    ! -> half way TRUE
      EGMReset guide;
      TRYNEXT;
    ENDIF
  ENDPROC
ENDMODULE
