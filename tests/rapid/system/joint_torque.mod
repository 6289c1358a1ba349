! RAPID Instructions, GetJointData: torques are not simulated, and the run says so.
MODULE joint_torque
  PROC main()
    VAR num torque:=5;
    GetJointData 1\Torque:=torque;          ! warning: R104
    TPWrite ValToStr(torque);               ! -> 0
  ENDPROC
ENDMODULE
